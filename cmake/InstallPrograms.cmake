# SPDX-License-Identifier: Apache-2.0
# `cmake --install BUILD --component programs`, and images. The programs find each other, and what reads images, beside themselves: all lie
# in one folder of their own, and bin/ has a link to the first.
get_property(verbs GLOBAL PROPERTY VITRAIL_VERBS)
set(folder ${CMAKE_INSTALL_LIBEXECDIR}/vitrail)
set(documents ${CMAKE_INSTALL_DATADIR}/doc/vitrail)
list(TRANSFORM verbs PREPEND vitrail- OUTPUT_VARIABLE programs)
install(TARGETS vitrail ${programs} RUNTIME DESTINATION ${folder} COMPONENT programs)
# Apart, as the libraries behind it are many.
install(TARGETS vitrail_assimp_module vitrail_openimageio LIBRARY DESTINATION ${folder} COMPONENT images)
file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/link)
file(RELATIVE_PATH from_bin ${CMAKE_INSTALL_FULL_BINDIR} ${CMAKE_INSTALL_FULL_LIBEXECDIR}/vitrail/vitrail)
file(CREATE_LINK ${from_bin} ${CMAKE_BINARY_DIR}/link/vitrail SYMBOLIC)
install(FILES ${CMAKE_BINARY_DIR}/link/vitrail DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)

# Pages and completions are what the programs write of their own options.
set(written ${CMAKE_BINARY_DIR}/written)
file(MAKE_DIRECTORY ${written})
set(pages)
foreach(program vitrail ${programs})
  set(page ${written}/${program}.1.gz)
  add_custom_command(OUTPUT ${page} DEPENDS ${program} VERBATIM
    COMMAND sh -c "\"$1\" --describe man | gzip -9nc > \"$2\"" sh $<TARGET_FILE:${program}> ${page})
  list(APPEND pages ${page})
endforeach()
install(FILES ${pages} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)

# vitrail_completion(SHELL FILE FOLDER): installed as DATADIR/FOLDER/FILE.
set(completions)
function(vitrail_completion shell file folder)
  add_custom_command(OUTPUT ${written}/${shell}/${file} DEPENDS vitrail ${programs} VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${written}/${shell}
    COMMAND sh -c "\"$1\" completion \"$2\" > \"$3\"" sh $<TARGET_FILE:vitrail> ${shell} ${written}/${shell}/${file})
  install(FILES ${written}/${shell}/${file} DESTINATION ${CMAKE_INSTALL_DATADIR}/${folder} COMPONENT programs)
  set(completions ${completions} ${written}/${shell}/${file} PARENT_SCOPE)
endfunction()
vitrail_completion(bash vitrail bash-completion/completions)
vitrail_completion(zsh _vitrail zsh/site-functions)
vitrail_completion(fish vitrail.fish fish/vendor_completions.d)
add_custom_target(manuals ALL DEPENDS ${pages} ${completions})

install(FILES README.md CHANGELOG.md SECURITY.md THIRD_PARTY.md DESTINATION ${documents} COMPONENT programs)
install(DIRECTORY docs DESTINATION ${documents} COMPONENT programs)
install(DIRECTORY examples DESTINATION ${documents} COMPONENT programs PATTERN __pycache__ EXCLUDE)
file(CREATE_LINK cornell-box/cornell-box.pbrt ${CMAKE_BINARY_DIR}/link/cornell-box.pbrt SYMBOLIC)
install(FILES ${CMAKE_BINARY_DIR}/link/cornell-box.pbrt DESTINATION ${documents}/examples COMPONENT programs)
