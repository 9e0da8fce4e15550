# Writes OUT: the page in the folder PAGE and the library WASM as one file. The modules become one script, which the page gives to its worker
# as well: an import or export is a line, or the start of one, and no two modules have a name in common.
cmake_minimum_required(VERSION 3.25)

set(code "")
foreach(module IN ITEMS engine worker plot controls state scene tables rod main)
  file(READ "${PAGE}/${module}.js" text)
  string(REGEX REPLACE "(^|\n)import [^\n]*" "\\1" text "${text}")
  string(REGEX REPLACE "(^|\n)export " "\\1" text "${text}")
  string(APPEND code "${text}")
endforeach()
execute_process(COMMAND "${GZIP}" -9 -n -c "${WASM}" COMMAND "${BASE64}" -w 0 OUTPUT_VARIABLE library COMMAND_ERROR_IS_FATAL ANY)
file(READ "${PAGE}/style.css" style)
file(READ "${PAGE}/index.html" html)
string(REPLACE "/*style.css*/" "${style}" html "${html}")
string(REPLACE "/*code*/" "${code}" html "${html}")
string(REPLACE "/*library*/" "${library}" html "${html}")
file(WRITE "${OUT}" "${html}")
