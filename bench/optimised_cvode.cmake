# CVODE with optimisation, for bench_dry_peers: `cmake -DDIRECTORY=... -P optimised_cvode.cmake`.
#
# Debian compiles SUNDIALS without optimisation.  This takes the sources of Debian's package and builds what is
# needed of it, once, into DIRECTORY; the program finds these libraries, which have the same names, before
# Debian's.  Without a network it says so, and the comparison is left out.
set(name sundials-6.4.1)
set(sources sundials_6.4.1+dfsg1.orig.tar.xz)
set(hash c61157f1d4be06c704bea40cb131eb63ba2dada161989071604d0a0959cdf04a)
if(EXISTS "${DIRECTORY}/lib/libsundials_cvode.so.6")
    return()
endif()

# The sources lie beside the package, wherever this machine gets its packages from.
execute_process(COMMAND apt-get download --print-uris libsundials-dev OUTPUT_VARIABLE package ERROR_QUIET)
if(NOT package MATCHES "'([^']*)/[^/']*'")
    message("no CVODE with optimisation: apt-get does not know where libsundials-dev comes from")
    return()
endif()
set(address "${CMAKE_MATCH_1}/${sources}")
file(MAKE_DIRECTORY "${DIRECTORY}")
set(archive "${DIRECTORY}/sources.tar.xz")
file(DOWNLOAD ${address} "${archive}" STATUS status INACTIVITY_TIMEOUT 30)
set(got "")
if(EXISTS "${archive}")
    file(SHA256 "${archive}" got)
endif()
if(NOT got STREQUAL hash)
    message("no CVODE with optimisation: ${address} could not be had (${status})")
    file(REMOVE "${archive}")
    return()
endif()
file(ARCHIVE_EXTRACT INPUT "${archive}" DESTINATION "${DIRECTORY}")
file(REMOVE "${archive}")

foreach(part ARKODE CVODES IDA IDAS KINSOL STATIC_LIBS)
    list(APPEND without -DBUILD_${part}=OFF)
endforeach()
set(log "${DIRECTORY}/log")
execute_process(
    COMMAND "${CMAKE_COMMAND}" -S "${DIRECTORY}/${name}" -B "${DIRECTORY}/build" ${without}
        -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS_RELEASE=-O3 -DEXAMPLES_ENABLE_C=OFF -DEXAMPLES_INSTALL=OFF
        -DCMAKE_INSTALL_PREFIX=${DIRECTORY} -DCMAKE_INSTALL_LIBDIR=lib
    OUTPUT_FILE "${log}" ERROR_FILE "${log}" RESULT_VARIABLE failed)
if(NOT failed)
    execute_process(COMMAND "${CMAKE_COMMAND}" --build "${DIRECTORY}/build" --parallel 2 --target install
        OUTPUT_FILE "${log}" ERROR_FILE "${log}" RESULT_VARIABLE failed)
endif()
if(failed)
    message("no CVODE with optimisation: it could not be built; ${log} says why")
endif()
