# What the tools need (the physics in libfestoon needs the C library alone).  POSIX threads, libyaml, jansson and
# SQLite are required; HDF5, LAPACK, Cairo, MPI, cminpack, Expat, gnuplot and ffmpeg are optional, and a program without them says so in
# `festoon --version`.
#
# FESTOON_HDF5, FESTOON_MPI and so on switch the optional libraries: AUTO takes one where it is found, ON refuses to go
# on without it, OFF leaves it out.  FESTOON_HAVE_HDF5 and so on say whether it is used.

find_package(PkgConfig QUIET)
if(NOT PKG_CONFIG_FOUND)
    message(FATAL_ERROR "pkg-config is missing, by which libraries are found. On Debian: apt-get install pkg-config")
endif()

# A library without which there are no tools: `target` is PkgConfig::target.
macro(festoon_requires target module name package)
    pkg_check_modules(${target} QUIET IMPORTED_TARGET ${module})
    if(NOT ${target}_FOUND)
        message(FATAL_ERROR "festoon's tools need ${name}, and it is missing. On Debian: apt-get install ${package} "
            "(tools/install-packages.sh build installs all that is needed). -DFESTOON_TOOLS=OFF builds libfestoon alone.")
    endif()
endmacro()

# An optional one, by the first of `modules` that is found, which may say a version; `without` says what festoon then
# lacks.
macro(festoon_may_have target modules name package without)
    set(FESTOON_${target} AUTO CACHE STRING "use ${name}: ON, OFF, or AUTO: where it is found")
    set_property(CACHE FESTOON_${target} PROPERTY STRINGS AUTO ON OFF)
    set(FESTOON_HAVE_${target} OFF)
    if(FESTOON_${target})
        pkg_search_module(${target} QUIET IMPORTED_TARGET ${modules})
        if(${target}_FOUND)
            set(FESTOON_HAVE_${target} ON)
        elseif(FESTOON_${target} STREQUAL "AUTO")
            message(STATUS "${name} not found (${package}): festoon ${without}")
        else()
            message(FATAL_ERROR "FESTOON_${target} is ON, but ${name} is missing. On Debian: apt-get install ${package}.")
        endif()
    endif()
    if(NOT FESTOON_HAVE_${target}) # a module of an earlier build would be loaded
        string(TOLOWER "${target}" festoon_module)
        string(REPLACE "cminpack" "minpack" festoon_module "${festoon_module}")
        file(REMOVE "${PROJECT_BINARY_DIR}/festoon-${festoon_module}.so")
    endif()
endmacro()

# libfestoon itself needs the C library alone; what seeks orbits loads LAPACK as a module.
festoon_may_have(LAPACK lapacke "LAPACKE" liblapacke-dev "will seek no orbits")

set(FESTOON_HAVE_HDF5 OFF)
set(FESTOON_HAVE_CAIRO OFF)
set(FESTOON_HAVE_MPI OFF)
set(FESTOON_HAVE_CMINPACK OFF)
set(FESTOON_HAVE_EXPAT OFF)
if(NOT FESTOON_TOOLS)
    return()
endif()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
festoon_requires(YAML yaml-0.1 "libyaml, which reads scenes" libyaml-dev)
festoon_requires(JANSSON jansson "jansson, which writes JSON" libjansson-dev)
festoon_requires(SQLITE sqlite3 "SQLite, which keeps sweeps" libsqlite3-dev)
# The serial flavour first: plain `hdf5` may be Debian's alternative that needs MPI.
festoon_may_have(HDF5 "hdf5-serial;hdf5" "HDF5" libhdf5-dev "will read and write no .h5 files")
festoon_may_have(CAIRO cairo "Cairo" libcairo2-dev "will make no films")
# Sweeps by several processes, on one machine or many.
festoon_may_have(MPI ompi-c "Open MPI" libopenmpi-dev "sweep will run as one process only")
festoon_may_have(CMINPACK cminpack "cminpack" libcminpack-dev "will fit no parameters")
# From 2.4 on it stops entities that grow without end.
festoon_may_have(EXPAT "expat>=2.4" "Expat 2.4" libexpat1-dev
    "will read no tracks in XML (Tracker's projects, TrackMate)")

# gnuplot is run as a process when a figure is drawn; it need not be there now.
find_program(GNUPLOT_PROGRAM gnuplot)
mark_as_advanced(GNUPLOT_PROGRAM)
if(NOT GNUPLOT_PROGRAM)
    message(STATUS "gnuplot not found (gnuplot-nox): figures need it at run time")
endif()
