# Debian packages by CPack: the command, the library for C++, and the Python package. After a build by the preset
# `package`, cpack puts them into build/package.
set(HOOKE_MAINTAINER "hooke-remesh developers <hooke-remesh@users.noreply.github.com>" CACHE STRING
    "Who maintains the packages")

set(names_command hooke-remesh)
set(names_development libhooke-remesh-dev)
set(names_python python3-hooke-remesh)
set(components command development)
if(HOOKE_PYTHON)
  list(APPEND components python)
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hooke-remesh)
set(CPACK_PACKAGE_CONTACT ${HOOKE_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${HOOKE_MAINTAINER})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(summary "optimizes triangle meshes on their own surface")
set(text "It moves the vertices of a triangle mesh on the mesh's own surface until the
triangles are well shaped, flips edges, or makes a new mesh of the edge length
asked for. What the result keeps of the input is checked before it is written,
and a report tells what changed.")

set(CPACK_COMPONENT_COMMAND_DESCRIPTION "${summary} (command)\n${text}")
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME ${names_command})
set(CPACK_DEBIAN_COMMAND_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMMAND_PACKAGE_SHLIBDEPS ON)

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${summary} (library for C++)\n${text}\n.\nThis package has the library, its headers, and what CMake and pkg-config need.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ${names_development})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
string(JOIN ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
       libopenmesh-dev libeigen3-dev libboost-dev nlohmann-json3-dev libtbb-dev libfmt-dev libssl-dev libexpat1-dev
       zlib1g-dev)

set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${summary} (package for Python 3)\n${text}\n.\nThis package works on numpy arrays.")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME ${names_python})
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
if(HOOKE_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
endif()

# What every package has to say of itself.
find_program(GZIP gzip REQUIRED)
configure_file(${CMAKE_CURRENT_LIST_DIR}/changelog.in ${PROJECT_BINARY_DIR}/packaging/changelog @ONLY)
execute_process(COMMAND ${GZIP} -9nfk changelog WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/packaging
                COMMAND_ERROR_IS_FATAL ANY)
file(READ LICENSE licence)
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" licence " ${licence}")
configure_file(${CMAKE_CURRENT_LIST_DIR}/copyright.in ${PROJECT_BINARY_DIR}/packaging/copyright @ONLY)
foreach(component IN LISTS components)
  install(FILES ${PROJECT_BINARY_DIR}/packaging/copyright ${PROJECT_BINARY_DIR}/packaging/changelog.gz
          DESTINATION share/doc/${names_${component}} COMPONENT ${component})
endforeach()

include(CPack)
