# cmake -C jobs/release.cmake -S . -B build: what is measured and used.
set(CMAKE_BUILD_TYPE Release CACHE STRING "")
