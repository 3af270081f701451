cablenet_script_test(cases_ranks cases/ranks.py 600 cases)
