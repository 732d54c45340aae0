# CMake generated Testfile for 
# Source directory: /tmp/wt/lead/tests/cli
# Build directory: /tmp/wt/lead/build-bench/tests/cli
# 
# This file includes the relevant testing commands required for 
# testing this directory and lists subdirectories to be tested as well.
add_test([=[cli.exit_codes]=] "/root/.pyenv/shims/python3" "/tmp/wt/lead/tests/cli/exit_codes_test.py")
set_tests_properties([=[cli.exit_codes]=] PROPERTIES  ENVIRONMENT "HOOKE_REMESH=/tmp/wt/lead/build-bench/apps/hooke-remesh;PYTHONDONTWRITEBYTECODE=1" SKIP_RETURN_CODE "77" _BACKTRACE_TRIPLES "/tmp/wt/lead/tests/cli/CMakeLists.txt;6;add_test;/tmp/wt/lead/tests/cli/CMakeLists.txt;0;")
add_test([=[cli.report]=] "/root/.pyenv/shims/python3" "/tmp/wt/lead/tests/cli/report_test.py")
set_tests_properties([=[cli.report]=] PROPERTIES  ENVIRONMENT "HOOKE_REMESH=/tmp/wt/lead/build-bench/apps/hooke-remesh;PYTHONDONTWRITEBYTECODE=1" SKIP_RETURN_CODE "77" _BACKTRACE_TRIPLES "/tmp/wt/lead/tests/cli/CMakeLists.txt;6;add_test;/tmp/wt/lead/tests/cli/CMakeLists.txt;0;")
add_test([=[cli.result]=] "/root/.pyenv/shims/python3" "/tmp/wt/lead/tests/cli/result_test.py")
set_tests_properties([=[cli.result]=] PROPERTIES  ENVIRONMENT "HOOKE_REMESH=/tmp/wt/lead/build-bench/apps/hooke-remesh;PYTHONDONTWRITEBYTECODE=1" SKIP_RETURN_CODE "77" _BACKTRACE_TRIPLES "/tmp/wt/lead/tests/cli/CMakeLists.txt;6;add_test;/tmp/wt/lead/tests/cli/CMakeLists.txt;0;")
add_test([=[cli.signals]=] "/root/.pyenv/shims/python3" "/tmp/wt/lead/tests/cli/signals_test.py")
set_tests_properties([=[cli.signals]=] PROPERTIES  ENVIRONMENT "HOOKE_REMESH=/tmp/wt/lead/build-bench/apps/hooke-remesh;PYTHONDONTWRITEBYTECODE=1" SKIP_RETURN_CODE "77" _BACKTRACE_TRIPLES "/tmp/wt/lead/tests/cli/CMakeLists.txt;6;add_test;/tmp/wt/lead/tests/cli/CMakeLists.txt;0;")
add_test([=[cli.corpus]=] "/root/.pyenv/shims/python3" "/tmp/wt/lead/tests/cli/corpus_test.py" "/tmp/wt/lead/../shared/corpus" "341")
set_tests_properties([=[cli.corpus]=] PROPERTIES  ENVIRONMENT "HOOKE_REMESH=/tmp/wt/lead/build-bench/apps/hooke-remesh;PYTHONDONTWRITEBYTECODE=1" SKIP_RETURN_CODE "77" _BACKTRACE_TRIPLES "/tmp/wt/lead/tests/cli/CMakeLists.txt;12;add_test;/tmp/wt/lead/tests/cli/CMakeLists.txt;0;")
