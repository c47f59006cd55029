# Writes the script of zoomable figures as a header: dygraphs as it is installed, never a copy of ours,
# and zoom.js behind it. Without dygraphs both are empty, and pages keep their static pictures.
# -DDYGRAPHS=folder or nothing, -DZOOM=zoom.js, -DOUTPUT=header
set(script "")
set(style "")
if(DYGRAPHS)
  file(READ ${DYGRAPHS}/dygraph.min.js script)
  file(READ ${DYGRAPHS}/dygraph.min.css style)
  file(READ ${ZOOM} own)
  # The map of its sources is not in a page that needs nothing else.
  string(REGEX REPLACE "/[/*]# sourceMappingURL=[^\n]*" "" script "${script}")
  string(REGEX REPLACE "/[/*]# sourceMappingURL=[^\n]*" "" style "${style}")
  string(APPEND script "\n${own}")
  if(script MATCHES "</script" OR script MATCHES "\\)zoom\"" OR style MATCHES "</style")
    message(FATAL_ERROR "${DYGRAPHS}: cannot stand inside a page")
  endif()
endif()
set(text "// Made by embed_zoom.cmake.\n#pragma once\n\nnamespace drift::report::detail {\n\n")
string(APPEND text "inline constexpr char zoom_script[] = R\"zoom(${script})zoom\";\n")
string(APPEND text "inline constexpr char zoom_style[] = R\"zoom(${style})zoom\";\n")
string(APPEND text "\n}  // namespace drift::report::detail\n")
file(WRITE ${OUTPUT}.new "${text}")
file(COPY_FILE ${OUTPUT}.new ${OUTPUT} ONLY_IF_DIFFERENT)
file(REMOVE ${OUTPUT}.new)
