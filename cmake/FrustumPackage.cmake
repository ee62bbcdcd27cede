# `make package`: a Debian package with the program, its man pages and completion, the machines, the documents,
# the C++ library and, where it was built, the Python module.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME frustum)
set(CPACK_PACKAGE_VENDOR "Frustum")
set(CPACK_PACKAGE_CONTACT "The Frustum authors <frustum@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "virtual five-axis machine tool: NC program in, CMM report out")
set(CPACK_PACKAGE_DESCRIPTION
    "Reads an NC program, runs it on a machine with geometric errors under their ISO 230-1 names, cuts the part,
probes it with a virtual CMM and reports form, size, orientation and position.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
if(TARGET frustum_python)
  get_target_property(minor frustum_python FRUSTUM_PYTHON_MINOR)
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3 (>= 3.${minor}), python3 (<< 3.${next}), python3-numpy")
endif()
include(CPack)
