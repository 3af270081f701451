include(${CMAKE_CURRENT_LIST_DIR}/broken.cmake)
cablenet_script_test(cases_crash cases/crash.py 300 cases)
cablenet_script_test(cases_paraview cases/paraview_read.py 120 cases)
