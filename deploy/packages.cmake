# Debian packages, one per component: laneloomd, laneloom, laneloom-lab, laneloom-dev, and python3-laneloom where it is built.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "laneloom maintainers <maintainers@laneloom.invalid>")
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL service tools lab development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEBIAN_SERVICE_PACKAGE_NAME laneloomd)
set(CPACK_DEBIAN_SERVICE_PACKAGE_SECTION misc)
set(CPACK_COMPONENT_SERVICE_DESCRIPTION "The service laneloomd, run by systemd.")
set(CPACK_DEBIAN_SERVICE_PACKAGE_DEPENDS "init-system-helpers, systemd")
set(CPACK_DEBIAN_SERVICE_PACKAGE_RECOMMENDS laneloom)
set(control ${CMAKE_CURRENT_SOURCE_DIR}/debian)
set(CPACK_DEBIAN_SERVICE_PACKAGE_CONTROL_EXTRA
    ${control}/conffiles ${control}/postinst ${control}/prerm ${control}/postrm)
set(CPACK_DEBIAN_SERVICE_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME laneloom)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION misc)
set(CPACK_COMPONENT_TOOLS_DESCRIPTION "The command that publishes, follows, records, replays, draws and rates.")
set(CPACK_DEBIAN_TOOLS_PACKAGE_RECOMMENDS fonts-dejavu-core)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SUGGESTS laneloomd)

set(CPACK_DEBIAN_LAB_PACKAGE_NAME laneloom-lab)
set(CPACK_DEBIAN_LAB_PACKAGE_SECTION misc)
set(CPACK_COMPONENT_LAB_DESCRIPTION "The command that measures laneloom itself, on simulated drives and under faults.")
set(CPACK_DEBIAN_LAB_PACKAGE_RECOMMENDS "laneloom, laneloomd")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME laneloom-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "IDL of the topics, and readers and writers of them for C++.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, libfastcdr-dev, lib${fast_dds}-dev")

if(LANELOOM_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-laneloom)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION "Maps of detections, and how good both are, for Python.")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${control}/python/postinst ${control}/python/prerm)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_STRICT_PERMISSION ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR}), python3 (<< ${Python_VERSION_MAJOR}.${next_minor}), python3-numpy")
endif()

# Each package has its licence and its history, where Debian looks for them.
set(changelog ${CMAKE_CURRENT_BINARY_DIR}/changelog.gz)
find_program(GZIP gzip REQUIRED)
execute_process(COMMAND ${GZIP} -9n INPUT_FILE ${control}/changelog OUTPUT_FILE ${changelog} COMMAND_ERROR_IS_FATAL ANY)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${control}/changelog)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} name)
  install(FILES ${control}/copyright ${changelog}
          DESTINATION share/doc/${CPACK_DEBIAN_${name}_PACKAGE_NAME} COMPONENT ${component})
endforeach()

include(CPack)
