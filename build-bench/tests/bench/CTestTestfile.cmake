# CMake generated Testfile for 
# Source directory: /tmp/wt/lead/tests/bench
# Build directory: /tmp/wt/lead/build-bench/tests/bench
# 
# This file includes the relevant testing commands required for 
# testing this directory and lists subdirectories to be tested as well.
