# Installs the library: its public headers and those that they include, and what find_package() and pkg-config need.
include(CMakePackageConfigHelpers)

set(public_headers
  hooke/core/error.h
  hooke/core/parallel.h
  hooke/io/read_mesh.h
  hooke/io/write_mesh.h
  hooke/measure/deviation.h
  hooke/measure/quality.h
  hooke/mesh/mesh.h
  hooke/mesh/valid_mesh.h
  hooke/remesh/array_remesh.h
  hooke/remesh/preserving_remesh.h
  hooke/remesh/remesh.h
  hooke/report/report.h
  hooke/springs/sizing.h
)

set(headers ${public_headers})
set(unread ${public_headers})
while(unread)
  list(POP_FRONT unread header)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${header})
  file(STRINGS ${header} includes REGEX "^#include \"hooke/")
  foreach(line IN LISTS includes)
    string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" included "${line}")
    if(NOT included IN_LIST headers)
      list(APPEND headers ${included})
      list(APPEND unread ${included})
    endif()
  endforeach()
endwhile()
foreach(header IN LISTS headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${folder} COMPONENT development)
endforeach()

install(TARGETS hooke EXPORT hooke_remesh
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} NAMELINK_COMPONENT development)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/hooke_remesh)
install(EXPORT hooke_remesh FILE hooke_remeshTargets.cmake NAMESPACE hooke:: DESTINATION ${package_folder}
        COMPONENT development)
configure_package_config_file(hooke_remeshConfig.cmake.in hooke_remeshConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(hooke_remeshConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hooke_remeshConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/hooke_remeshConfigVersion.cmake
        DESTINATION ${package_folder} COMPONENT development)

file(RELATIVE_PATH prefix_from_pkgconfig /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(hooke_remesh.pc.in hooke_remesh.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hooke_remesh.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
        COMPONENT development)
