# What `cmake --install` puts where: libraries, headers, program, manual page, and the two ways by which other
# projects find festoon, pkg-config and find_package(festoon).

include(CMakePackageConfigHelpers)

set(FESTOON_ZSH_FOLDER "zsh/site-functions" CACHE STRING "folder for zsh's completion, in DATADIR")
mark_as_advanced(FESTOON_ZSH_FOLDER)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/festoon")
set(pkgconfig_dir "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
# The .pc files say where they are relative to themselves, so that an installed tree may be moved.
file(RELATIVE_PATH pkgconfig_to_prefix
    "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
string(REGEX REPLACE "/$" "" pkgconfig_to_prefix "${pkgconfig_to_prefix}")

set(exported_libraries festoon_library)
install(FILES include/festoon/festoon.h include/festoon/orbits.h include/festoon/rows.h include/festoon/field_maps.h
    include/festoon/beads.h
    include/festoon/params.def include/festoon/run.def include/festoon/lists.def include/festoon/physics.def
    "${festoon_own_def}"
    DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/festoon")
configure_file(cmake/festoon.pc.in festoon.pc @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/festoon.pc" DESTINATION "${pkgconfig_dir}")

if(FESTOON_TOOLS)
    list(APPEND exported_libraries festoon_tools_library)
    install(FILES include/festoon/festoon_tools.h include/festoon/look.h include/festoon/charts.h
            include/festoon/fit.h include/festoon/tracks.h include/festoon/film_tracks.h include/festoon/measure.def
            include/festoon/bead_files.h
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/festoon")
    configure_file(cmake/festoon-tools.pc.in festoon-tools.pc @ONLY)
    install(FILES "${PROJECT_BINARY_DIR}/festoon-tools.pc" DESTINATION "${pkgconfig_dir}")
    install(TARGETS festoon_program RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
    install(FILES "${PROJECT_BINARY_DIR}/docs/festoon.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1")
    install(DIRECTORY examples DESTINATION "${CMAKE_INSTALL_DOCDIR}" USE_SOURCE_PERMISSIONS
        FILES_MATCHING PATTERN "*.yaml" PATTERN "*.csv" PATTERN "*.c" PATTERN "*.inl" PATTERN "*.def" PATTERN "*.sh" PATTERN "*.sbatch"
        PATTERN "*.py" PATTERN "*.ipynb")
    # Shells look in these folders for what completes the words of a program.
    set(completion_dir "${PROJECT_BINARY_DIR}/completion")
    install(FILES "${completion_dir}/festoon.bash" RENAME festoon
        DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
    install(FILES "${completion_dir}/festoon.zsh" RENAME _festoon
        DESTINATION "${CMAKE_INSTALL_DATADIR}/${FESTOON_ZSH_FOLDER}")
    install(FILES "${completion_dir}/festoon.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d")
    if(FESTOON_HAVE_HDF5)
        install(TARGETS festoon_hdf5_module LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/festoon")
    endif()
    if(FESTOON_HAVE_MPI)
        install(TARGETS festoon_mpi_module LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/festoon")
    endif()
    if(FESTOON_HAVE_CMINPACK)
        install(TARGETS festoon_minpack_module LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/festoon")
    endif()
    if(FESTOON_HAVE_CAIRO)
        install(TARGETS festoon_cairo_module LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/festoon")
    endif()
endif()

if(FESTOON_HAVE_LAPACK)
    install(TARGETS festoon_lapack_module LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/festoon")
endif()
install(TARGETS ${exported_libraries} EXPORT festoonTargets
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT festoonTargets NAMESPACE festoon:: DESTINATION "${package_dir}")
configure_package_config_file(cmake/festoonConfig.cmake.in festoonConfig.cmake
    INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file(festoonConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/festoonConfig.cmake" "${PROJECT_BINARY_DIR}/festoonConfigVersion.cmake"
    DESTINATION "${package_dir}")
install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}")
