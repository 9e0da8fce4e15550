# CITATION.cff must name VERSION and DATE: an old one would override the release's own data wherever it is archived.
cmake_minimum_required(VERSION 3.25)

file(READ "${FILE}" text)
foreach(line IN ITEMS "cff-version: 1.2.0" "version: ${VERSION}" "date-released: ${DATE}")
  string(FIND "\n${text}" "\n${line}\n" found)
  if(found EQUAL -1)
    message(SEND_ERROR "${FILE} does not have the line \"${line}\"")
  endif()
endforeach()
