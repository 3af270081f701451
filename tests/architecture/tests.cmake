# Rules of the tree itself; the rooms come from the top CMakeLists.txt.
set(architecture_dir ${CMAKE_CURRENT_LIST_DIR})

add_test(NAME architecture_includes
  COMMAND ${CABLENET_PYTHON} ${architecture_dir}/includes.py --root ${CMAKE_SOURCE_DIR}
    --physics ${CABLENET_PHYSICS_ROOMS} --machinery ${CABLENET_MACHINERY_ROOMS})
add_test(NAME architecture_sizes
  COMMAND ${CABLENET_PYTHON} ${architecture_dir}/sizes.py --root ${CMAKE_SOURCE_DIR})
add_test(NAME architecture_format
  COMMAND ${CABLENET_PYTHON} ${architecture_dir}/format.py --root ${CMAKE_SOURCE_DIR})
add_test(NAME architecture_rebuilds
  COMMAND ${CABLENET_PYTHON} ${architecture_dir}/rebuilds.py --root ${CMAKE_SOURCE_DIR}
    --rooms environment elements bodies
    --data environment/bed.hpp environment/fluid.hpp elements/cable_data.hpp elements/static_rule.hpp bodies/body_data.hpp bodies/carried_data.hpp)
add_test(NAME architecture_self_test
  COMMAND ${CABLENET_PYTHON} ${architecture_dir}/self_test.py)

set_tests_properties(architecture_includes architecture_sizes architecture_format architecture_rebuilds
  architecture_self_test PROPERTIES TIMEOUT 60 LABELS architecture)
set_tests_properties(architecture_format PROPERTIES SKIP_RETURN_CODE 77)
