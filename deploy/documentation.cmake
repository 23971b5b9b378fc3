# `cmake --build build --target doc`: what the headers of laneloom-dev and the IDL say, as pages for a browser in
# build/docs/html. A warning of Doxygen is an error (make-docs).
find_package(Doxygen 1.9 QUIET)
if(DOXYGEN_FOUND)
  configure_file(${CMAKE_CURRENT_SOURCE_DIR}/Doxyfile ${CMAKE_CURRENT_BINARY_DIR}/Doxyfile @ONLY)
  add_custom_target(doc
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/docs
    COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/make-docs ${CMAKE_CURRENT_BINARY_DIR}/Doxyfile
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    COMMENT "Documentation of the headers and of the IDL"
    VERBATIM)
endif()
