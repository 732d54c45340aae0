# CMake generated Testfile for 
# Source directory: /tmp/wt/lead/tests
# Build directory: /tmp/wt/lead/build-bench/tests
# 
# This file includes the relevant testing commands required for 
# testing this directory and lists subdirectories to be tested as well.
include("/tmp/wt/lead/build-bench/tests/hooke_tests[1]_include.cmake")
subdirs("cli")
