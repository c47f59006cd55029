# The list of what the program is made of, as CycloneDX JSON: the libraries that the configuration found.
#   write_sbom(FILE "SUNDIALS=6.4.1|Eigen=3.4.0|Random123=|...")   what does not say its version has none
function(write_sbom file libraries)
  string(REPLACE "|" ";" libraries "${libraries}")
  set(components)
  foreach(library IN LISTS libraries)
    if(library MATCHES "^([^=]+)=([^=]*)$")
      set(version)
      if(CMAKE_MATCH_2)
        set(version ", \"version\": \"${CMAKE_MATCH_2}\"")
      endif()
      list(APPEND components "    {\"type\": \"library\", \"name\": \"${CMAKE_MATCH_1}\"${version}}")
    endif()
  endforeach()
  list(JOIN components ",\n" components)
  file(WRITE ${file} "{
  \"bomFormat\": \"CycloneDX\",
  \"specVersion\": \"1.4\",
  \"version\": 1,
  \"metadata\": {\"component\": {\"type\": \"application\", \"name\": \"driftscope\", \"version\": \"${PROJECT_VERSION}\"}},
  \"components\": [
${components}
  ]
}
")
endfunction()
