# Third-party libraries, all from the distribution (docs/decisions/0002-libraries.md).
find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
# OpenEXR through pkg-config: Debian's Imath CMake package names a Python library that only another package has.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OPENEXR REQUIRED IMPORTED_TARGET OpenEXR)

# The window, which only the program has.
find_package(glfw3 3.3 REQUIRED)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)

find_path(LODEPNG_INCLUDE lodepng.h REQUIRED)
find_library(LODEPNG_LIBRARY lodepng REQUIRED)
add_library(welkin_lodepng INTERFACE)
target_include_directories(welkin_lodepng SYSTEM INTERFACE ${LODEPNG_INCLUDE})
target_link_libraries(welkin_lodepng INTERFACE ${LODEPNG_LIBRARY})
set_target_properties(welkin_lodepng PROPERTIES EXPORT_NAME lodepng)

# glad writes the OpenGL and EGL loaders at configure time.
find_program(GLAD glad REQUIRED)
set(GLAD_DIR ${CMAKE_BINARY_DIR}/glad)
if(NOT EXISTS ${GLAD_DIR}/src/gl.c OR NOT EXISTS ${GLAD_DIR}/src/egl.c)
  execute_process(COMMAND ${GLAD} --quiet --reproducible --out-path ${GLAD_DIR}
    --api gl:core=4.5 --extensions GL_KHR_debug c --loader COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${GLAD} --quiet --reproducible --out-path ${GLAD_DIR} --api egl=1.5
    --extensions EGL_EXT_platform_base,EGL_EXT_device_base,EGL_EXT_device_query,EGL_EXT_device_enumeration,EGL_EXT_platform_device,EGL_MESA_platform_surfaceless,EGL_KHR_create_context
    c --loader COMMAND_ERROR_IS_FATAL ANY)
endif()
add_library(welkin_glad STATIC ${GLAD_DIR}/src/gl.c ${GLAD_DIR}/src/egl.c)
target_include_directories(welkin_glad SYSTEM PUBLIC
  $<BUILD_INTERFACE:${GLAD_DIR}/include> $<INSTALL_INTERFACE:include/welkin/glad-4.5>)
target_link_libraries(welkin_glad PUBLIC ${CMAKE_DL_LIBS})
set_target_properties(welkin_glad PROPERTIES EXPORT_NAME glad)

# Warnings are errors. -ffp-contract=off: the C++ twin of a shader function rounds after every operation, as GLSL does.
add_library(welkin_warnings INTERFACE)
target_compile_options(welkin_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror -ffp-contract=off
  $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>)  # a note about GCC before 4.6, whose code nothing here meets
if(WELKIN_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()
if(WELKIN_TSAN)
  add_compile_options(-fsanitize=thread)
  add_link_options(-fsanitize=thread)
endif()
