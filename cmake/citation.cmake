# What the program says of itself when it is cited, read from CITATION.cff: the installed program has no source tree to look in.
# Sets THINWALL_CITATION_TITLE, _AUTHORS (a BibTeX list) and _LICENSE. Of YAML it knows what that file uses.
set(cff "${PROJECT_SOURCE_DIR}/CITATION.cff")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${cff}")

function(thinwall_cff_value key out)
  file(STRINGS "${cff}" line REGEX "^${key}: ")
  if(NOT line)
    message(FATAL_ERROR "${cff}: the line \"${key}: ...\" is missing")
  endif()
  string(REGEX REPLACE "^${key}: *\"?([^\"]*)\"?$" "\\1" value "${line}")
  set(${out} "${value}" PARENT_SCOPE)
endfunction()

thinwall_cff_value(title THINWALL_CITATION_TITLE)
thinwall_cff_value(license THINWALL_CITATION_LICENSE)

# A group is `- name: ...`; a person is `- family-names: ...`, then `given-names: ...`.
set(THINWALL_CITATION_AUTHORS "")
file(STRINGS "${cff}" lines REGEX "^  (- name|- family-names|  given-names): ")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^[^:]*: *\"?([^\"]*)\"?$" "\\1" value "${line}")
  if(line MATCHES "given-names")
    string(APPEND THINWALL_CITATION_AUTHORS ", ${value}")
    continue()
  endif()
  if(THINWALL_CITATION_AUTHORS)
    string(APPEND THINWALL_CITATION_AUTHORS " and ")
  endif()
  if(line MATCHES "- name")
    set(value "{${value}}")  # kept whole
  endif()
  string(APPEND THINWALL_CITATION_AUTHORS "${value}")
endforeach()
if(NOT THINWALL_CITATION_AUTHORS)
  message(FATAL_ERROR "${cff}: no author is named")
endif()
