# What the Python module needs: a python3 with cffi, numpy and its header.
#
# The program is named, not searched for: another python3 that comes first on PATH would rarely have numpy and cffi.
# FESTOON_HAVE_PYTHON says whether the module is built.

set(FESTOON_HAVE_PYTHON OFF)
if(NOT FESTOON_PYTHON OR NOT FESTOON_TOOLS)
    return()
endif()
# A process with sanitizers needs them first; python3 is built without.
if(FESTOON_SANITIZE AND FESTOON_PYTHON STREQUAL "AUTO")
    return()
endif()

execute_process(
    COMMAND "${FESTOON_PYTHON_PROGRAM}" -I -c
"import importlib.util, os, sys, sysconfig
include = sysconfig.get_path('include')
lacks = [package for name, package in (('cffi', 'python3-cffi'), ('numpy', 'python3-numpy'))
         if importlib.util.find_spec(name) is None]
if not os.path.exists(os.path.join(include, 'Python.h')):
    lacks.append('python3-dev')
print(' '.join(lacks) if lacks else include)
sys.exit(bool(lacks))"
    OUTPUT_VARIABLE festoon_python_said OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_VARIABLE festoon_python_error RESULT_VARIABLE festoon_python_status)
if(festoon_python_status EQUAL 0)
    set(FESTOON_HAVE_PYTHON ON)
    set(FESTOON_PYTHON_INCLUDE "${festoon_python_said}")
elseif(FESTOON_PYTHON STREQUAL "AUTO")
    message(STATUS "${FESTOON_PYTHON_PROGRAM} lacks ${festoon_python_said}: the Python module is not built")
else()
    message(FATAL_ERROR "${FESTOON_PYTHON_PROGRAM} lacks ${festoon_python_said}${festoon_python_error}")
endif()
