cablenet_script_test(broken_scenes cases/broken_scenes.py 600 cases)
