# Completion for the shells and the manual page, which the command makes from its table of options.
set(zsh_folder ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
if(HOOKE_PACKAGES)  # as Debian has them
  set(zsh_folder ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
endif()

set(shell_files)
foreach(file IN ITEMS bash zsh fish man)
  set(made ${CMAKE_CURRENT_BINARY_DIR}/shell/hooke-remesh.${file})
  set(request --completion ${file})
  if(file STREQUAL man)
    set(request --man-page)
  endif()
  add_custom_command(OUTPUT ${made} DEPENDS hooke-remesh VERBATIM
                     COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/shell
                     COMMAND hooke-remesh ${request} > ${made})
  list(APPEND shell_files ${made})
endforeach()
if(HOOKE_PACKAGES)
  find_program(GZIP gzip REQUIRED)
  add_custom_command(OUTPUT ${made}.gz DEPENDS ${made} VERBATIM COMMAND ${GZIP} -9nfk ${made})  # the manual page
  list(APPEND shell_files ${made}.gz)
endif()
add_custom_target(hooke_shell_files ALL DEPENDS ${shell_files})

set(made ${CMAKE_CURRENT_BINARY_DIR}/shell/hooke-remesh)
install(FILES ${made}.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hooke-remesh)
install(FILES ${made}.zsh DESTINATION ${zsh_folder} RENAME _hooke-remesh)
install(FILES ${made}.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
if(HOOKE_PACKAGES)
  install(FILES ${made}.man.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME hooke-remesh.1.gz)
else()
  install(FILES ${made}.man DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME hooke-remesh.1)
endif()
