cablenet_script_test(broken_scenes cases/broken_scenes.py 300 cases)
