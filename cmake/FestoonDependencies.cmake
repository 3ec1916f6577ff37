# What the tools need (the physics in libfestoon needs the C library alone).  POSIX threads, libyaml, jansson and
# SQLite are required; HDF5, LAPACK, Cairo, MPI, cminpack, gnuplot and ffmpeg are optional, and a program without them says so in
# `festoon --version`.

# libfestoon itself needs the C library alone; what seeks orbits loads LAPACK as a module.
find_package(PkgConfig REQUIRED)
pkg_check_modules(LAPACKE QUIET IMPORTED_TARGET lapacke)
set(FESTOON_HAVE_LAPACK ${LAPACKE_FOUND})
if(NOT FESTOON_HAVE_LAPACK)
    message(STATUS "LAPACKE not found (liblapacke-dev): festoon will seek no orbits")
endif()

set(FESTOON_HAVE_HDF5 OFF)
set(FESTOON_HAVE_CAIRO OFF)
set(FESTOON_HAVE_MPI OFF)
set(FESTOON_HAVE_CMINPACK OFF)
if(NOT FESTOON_TOOLS)
    return()
endif()

set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
pkg_check_modules(YAML REQUIRED IMPORTED_TARGET yaml-0.1)
pkg_check_modules(JANSSON REQUIRED IMPORTED_TARGET jansson)
pkg_check_modules(SQLITE REQUIRED IMPORTED_TARGET sqlite3)

# The serial flavour first: plain `hdf5` may be Debian's alternative that needs MPI.
pkg_search_module(HDF5 QUIET IMPORTED_TARGET hdf5-serial hdf5)
if(HDF5_FOUND)
    set(FESTOON_HAVE_HDF5 ON)
else()
    message(STATUS "HDF5 not found (libhdf5-dev): festoon will read and write no .h5 files")
endif()

pkg_check_modules(CAIRO QUIET IMPORTED_TARGET cairo)
if(CAIRO_FOUND)
    set(FESTOON_HAVE_CAIRO ON)
else()
    message(STATUS "Cairo not found (libcairo2-dev): festoon will make no films")
endif()

# Open MPI: sweeps by several processes, on one machine or many.
pkg_check_modules(MPI QUIET IMPORTED_TARGET ompi-c)
if(MPI_FOUND)
    set(FESTOON_HAVE_MPI ON)
else()
    message(STATUS "Open MPI not found (libopenmpi-dev): festoon sweep will run as one process only")
endif()

pkg_check_modules(CMINPACK QUIET IMPORTED_TARGET cminpack)
if(CMINPACK_FOUND)
    set(FESTOON_HAVE_CMINPACK ON)
else()
    message(STATUS "cminpack not found (libcminpack-dev): festoon will fit no parameters")
endif()

# gnuplot is run as a process when a figure is drawn; it need not be there now.
find_program(GNUPLOT_PROGRAM gnuplot)
mark_as_advanced(GNUPLOT_PROGRAM)
if(NOT GNUPLOT_PROGRAM)
    message(STATUS "gnuplot not found (gnuplot-nox): figures need it at run time")
endif()
