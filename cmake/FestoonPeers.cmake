# Libraries of others that integrate what festoon integrates, for tests and benchmarks alone: targets festoon_cvode
# (SUNDIALS' CVODE) and festoon_siconos, each only where the library is installed.
include_guard(GLOBAL)

find_path(SUNDIALS_INCLUDE_DIR cvode/cvode.h)
mark_as_advanced(SUNDIALS_INCLUDE_DIR)
set(sundials_libraries)
foreach(name cvode nvecserial sunmatrixdense sunlinsoldense)
    find_library(SUNDIALS_${name}_LIBRARY sundials_${name})
    mark_as_advanced(SUNDIALS_${name}_LIBRARY)
    list(APPEND sundials_libraries "${SUNDIALS_${name}_LIBRARY}")
endforeach()
if(SUNDIALS_INCLUDE_DIR AND NOT sundials_libraries MATCHES "NOTFOUND")
    add_library(festoon_cvode INTERFACE)
    target_include_directories(festoon_cvode SYSTEM INTERFACE "${SUNDIALS_INCLUDE_DIR}")
    target_link_libraries(festoon_cvode INTERFACE ${sundials_libraries})
endif()

# Its headers include each other without their folders.
find_path(SICONOS_INCLUDE_DIR siconos/numerics/NonSmoothDrivers.h)
find_library(SICONOS_numerics_LIBRARY siconos_numerics)
mark_as_advanced(SICONOS_INCLUDE_DIR SICONOS_numerics_LIBRARY)
if(SICONOS_INCLUDE_DIR AND SICONOS_numerics_LIBRARY)
    add_library(festoon_siconos INTERFACE)
    target_include_directories(festoon_siconos SYSTEM INTERFACE
        "${SICONOS_INCLUDE_DIR}/siconos" "${SICONOS_INCLUDE_DIR}/siconos/numerics")
    target_link_libraries(festoon_siconos INTERFACE "${SICONOS_numerics_LIBRARY}")
endif()
