# Debian packages, one per component: `cpack -G DEB`, or tools/dev package, which configures for /usr.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME limpid)
set(CPACK_PACKAGE_VENDOR limpid)
set(CPACK_PACKAGE_CONTACT "The limpid developers <limpid@localhost>" CACHE STRING "Who maintains the packages")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
    WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

# The name of a library's package changes with its SOVERSION.
set(SERIES ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(EXACTLY "(= ${PROJECT_VERSION})")
function(limpid_debian component package section)
  cmake_parse_arguments(PARSE_ARGV 3 deb "" "DESCRIPTION" "DEPENDS;SUGGESTS")
  string(TOUPPER ${component} key)
  list(JOIN deb_DEPENDS ", " depends)
  list(JOIN deb_SUGGESTS ", " suggests)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SUGGESTS "${suggests}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${deb_DESCRIPTION}" PARENT_SCOPE)
  install(FILES copyright DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${package}
          COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

limpid_debian(core liblimpid${SERIES} libs
  DESCRIPTION "The library proper, on buffers in memory." SUGGESTS limpid libvulkan1)
limpid_debian(files liblimpid-files${SERIES} libs
  DESCRIPTION "The library from files to files: EXR, glTF, scenes, looks."
  DEPENDS "liblimpid${SERIES} ${EXACTLY}" SUGGESTS limpid)
limpid_debian(dev liblimpid-dev libdevel
  DESCRIPTION "Headers, static library, CMake package and pkg-config files."
  DEPENDS "liblimpid${SERIES} ${EXACTLY}" "liblimpid-files${SERIES} ${EXACTLY}" libglm-dev
  SUGGESTS libtbb-dev libhwy-dev libopencv-core-dev libopenimageio-dev)
limpid_debian(tool limpid graphics
  DESCRIPTION "The command-line tool, its looks and scenes, and formats other than EXR."
  SUGGESTS libvulkan1)

# The Python module installs itself as component python, where it is built.
get_cmake_property(CPACK_COMPONENTS_ALL COMPONENTS)
if("python" IN_LIST CPACK_COMPONENTS_ALL)
  limpid_debian(python python3-limpid python
    DESCRIPTION "The module for Python."
    DEPENDS ${LIMPID_PYTHON_DEPENDS} SUGGESTS limpid libvulkan1)
endif()
list(REMOVE_ITEM CPACK_COMPONENTS_ALL Unspecified)

include(CPack)
