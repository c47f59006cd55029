# What `cmake --install` puts where: the program, the libraries with their headers by layer, the files by
# which CMake and pkg-config find them, study files and job scripts, the Python reader, the manual page; and the Debian package that CPack makes.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(DRIFT_HEADERS ${CMAKE_INSTALL_INCLUDEDIR}/driftscope)
set(DRIFT_PACKAGE ${CMAKE_INSTALL_LIBDIR}/cmake/driftscope)
set(DRIFT_INSTALLED drift_flags drift_core drift_mc drift_analysis drift_report)
foreach(target IN LISTS DRIFT_INSTALLED)
  string(REPLACE "drift_" "" name ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
endforeach()

install(TARGETS driftscope COMPONENT driftscope)
install(TARGETS ${DRIFT_INSTALLED} EXPORT driftscope COMPONENT driftscope FILE_SET HEADERS DESTINATION ${DRIFT_HEADERS})
install(EXPORT driftscope NAMESPACE drift:: DESTINATION ${DRIFT_PACKAGE} COMPONENT driftscope)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/driftscope-config.cmake.in
  ${CMAKE_BINARY_DIR}/generated/driftscope-config.cmake INSTALL_DESTINATION ${DRIFT_PACKAGE})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/driftscope-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/generated/driftscope-config.cmake
  ${CMAKE_BINARY_DIR}/generated/driftscope-config-version.cmake DESTINATION ${DRIFT_PACKAGE} COMPONENT driftscope)

# pkg-config takes no targets: what the program links is named by the libraries' own .pc files, or as it is.
file(RELATIVE_PATH DRIFT_PC_UP /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
if(DRIFT_MPI AND MPI_C_FOUND)
  list(JOIN MPI_C_LIBRARIES " " DRIFT_PC_MPI)
endif()
list(JOIN OpenMP_CXX_LIBRARIES " " DRIFT_PC_OPENMP)
configure_file(${CMAKE_CURRENT_LIST_DIR}/driftscope.pc.in ${CMAKE_BINARY_DIR}/generated/driftscope.pc @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/generated/driftscope.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT driftscope)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/driftscope/configs
        USE_SOURCE_PERMISSIONS COMPONENT driftscope)
install(FILES ${DRIFT_MAN} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT driftscope)
file(GLOB DRIFT_PYTHON CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/analysis/python/*.py)
install(FILES ${DRIFT_PYTHON} DESTINATION ${CMAKE_INSTALL_DATADIR}/driftscope/python COMPONENT driftscope)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/LICENSE
        DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT driftscope)

include(${CMAKE_CURRENT_LIST_DIR}/sbom.cmake)
string(REGEX REPLACE "[|]MPI=.*" "" parts "${libraries}")
if(DRIFT_MPI AND MPI_C_FOUND)
  string(APPEND parts "|MPI=${MPI_C_VERSION}")
endif()
string(APPEND parts "|Random123=")
if(DYGRAPHS_DIR)
  file(STRINGS ${DYGRAPHS_DIR}/dygraph.min.js licence REGEX "@license" LIMIT_COUNT 1)
  string(REGEX REPLACE ".*/v([0-9.]+)/.*" "\\1" version "${licence}")
  string(APPEND parts "|dygraphs=${version}")
endif()
write_sbom(${CMAKE_BINARY_DIR}/generated/sbom.cdx.json "${parts}")
install(FILES ${CMAKE_BINARY_DIR}/generated/sbom.cdx.json ${CMAKE_CURRENT_LIST_DIR}/SECURITY.md
        ${CMAKE_CURRENT_LIST_DIR}/CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT driftscope)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME driftscope)
set(CPACK_PACKAGE_CONTACT "the maintainers of driftscope")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
include(CPack)
