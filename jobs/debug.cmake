# cmake -C jobs/debug.cmake -S . -B build-debug: for a debugger; the standard library and Eigen check their arguments.
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS_DEBUG "-Og -g -D_GLIBCXX_ASSERTIONS" CACHE STRING "")
