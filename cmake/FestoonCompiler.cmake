# How everything is compiled, and where it lands in the build tree.

if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo" FORCE)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# Program, libraries and module lie side by side at the top of the build tree, so that build/festoon runs in place.
# They find each other by search paths relative to themselves that hold there and in an installed tree: either may
# be moved, and CMake does not pad the paths with empty entries, which would mean the current directory.
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}")
set(CMAKE_BUILD_WITH_INSTALL_RPATH ON)
set(CMAKE_INSTALL_RPATH "$ORIGIN;$ORIGIN/..") # helpers, tests and benchmarks, in folders of the build tree

add_library(festoon_compiler INTERFACE)
# _POSIX_C_SOURCE: strict C11 hides fsync, isatty, popen and their like.
target_compile_definitions(festoon_compiler INTERFACE _POSIX_C_SOURCE=200809L)
target_compile_options(festoon_compiler INTERFACE
    -Wall -Wextra -Wpedantic -Wconversion -Wshadow
    # A trajectory's bits depend on its parameters alone: no fused operations behind the source's back,
    # and no -march, -ffast-math or other flag by which machines and compilers could differ.
    -ffp-contract=off
    # These two change no bits: sqrt need not set errno, and a library's own calls need not go through
    # its symbol table.
    -fno-math-errno -fno-semantic-interposition
    $<$<BOOL:${FESTOON_WERROR}>:-Werror>)

# Images of runs that a sweep keeps are read by the very build that made them alone: each has an identity.
target_link_options(festoon_compiler INTERFACE -Wl,--build-id)

if(FESTOON_SANITIZE)
    # What C leaves undefined ends the program by a signal, which AddressSanitizer reports with file and line: words for
    # each place in the code would make the libraries four times as large, and each start of the program take twice as long.
    target_compile_options(festoon_compiler INTERFACE -fsanitize=${FESTOON_SANITIZE} -fno-sanitize-recover=all
        $<$<C_COMPILER_ID:GNU>:-fsanitize-undefined-trap-on-error> -fno-omit-frame-pointer)
    # Sanitizers call dlopen on the caller's behalf, from a library that knows nothing of the caller's
    # RUNPATH; the old RPATH of the program holds for every library.
    target_link_options(festoon_compiler INTERFACE
        -fsanitize=${FESTOON_SANITIZE} -Wl,--disable-new-dtags)
endif()

set(CMAKE_C_STANDARD 11)
set(CMAKE_C_STANDARD_REQUIRED ON)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
