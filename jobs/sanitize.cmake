# cmake -C jobs/sanitize.cmake -S . -B build-sanitize: the first memory error or undefined behaviour ends the program with
# its place.  jobs/README.md says how to run the tests under it.
set(CMAKE_BUILD_TYPE Debug CACHE STRING "")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g -D_GLIBCXX_ASSERTIONS" CACHE STRING "")
set(CMAKE_CXX_FLAGS "-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer" CACHE STRING "")
