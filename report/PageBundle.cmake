# The script and the style of the HTML report: npm packages, bundled with our own sources into two files
# and embedded into the library. npm runs in the build tree, once for each package-lock.json; afterwards
# a build needs no network.
#
# Where there is no npm, FRUSTUM_PAGE_BUNDLE names a folder with page.js and page.css of another build.
set(FRUSTUM_PAGE_BUNDLE "" CACHE PATH "Folder with a ready page.js and page.css; empty: build them")

set(page_source "${CMAKE_CURRENT_SOURCE_DIR}/page")
set(page_build "${CMAKE_CURRENT_BINARY_DIR}/page")

if(FRUSTUM_PAGE_BUNDLE)
  set(page_bundle "${FRUSTUM_PAGE_BUNDLE}")
else()
  set(page_bundle "${page_build}/bundle")
  find_program(FRUSTUM_NODE node REQUIRED)
  find_program(FRUSTUM_NPM npm REQUIRED)
  set(page_packages package.json package-lock.json .npmrc)
  list(TRANSFORM page_packages PREPEND "${page_source}/" OUTPUT_VARIABLE page_package_sources)
  set(page_scripts axes.js crease_normals.js main.js packed_array.js plotly.js polar.js profile.js surface.js
      theme.js volumetric.js)
  list(TRANSFORM page_scripts PREPEND "${page_source}/")
  add_custom_command(
    OUTPUT "${page_build}/packages.stamp"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${page_build}"
    COMMAND "${CMAKE_COMMAND}" -E copy ${page_package_sources} "${page_build}"
    COMMAND "${CMAKE_COMMAND}" -E chdir "${page_build}" "${FRUSTUM_NPM}" ci --ignore-scripts
            --no-audit --no-fund --loglevel=error
    COMMAND "${CMAKE_COMMAND}" -E touch "${page_build}/packages.stamp"
    WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}"
    DEPENDS ${page_package_sources}
    COMMENT "Fetching the packages of the report page"
    VERBATIM)
  add_custom_command(
    OUTPUT "${page_bundle}/page.js" "${page_bundle}/page.css"
    COMMAND "${CMAKE_COMMAND}" -E copy "${page_source}/build.mjs" "${page_build}"
    COMMAND "${FRUSTUM_NODE}" "${page_build}/build.mjs" "${page_source}" "${page_bundle}"
    WORKING_DIRECTORY "${page_build}"
    DEPENDS "${page_build}/packages.stamp" "${page_source}/build.mjs" "${page_source}/style.css"
            ${page_scripts}
    COMMENT "Bundling the report page"
    VERBATIM)
endif()

# html/page_bundle.cpp embeds the bundle and the template.
set(page_template "${page_source}/template.html")
set_source_files_properties(
  html/page_bundle.cpp
  PROPERTIES OBJECT_DEPENDS "${page_bundle}/page.js;${page_bundle}/page.css;${page_template}")
set_property(
  SOURCE html/page_bundle.cpp
  PROPERTY COMPILE_DEFINITIONS FRUSTUM_PAGE_SCRIPT="${page_bundle}/page.js"
           FRUSTUM_PAGE_STYLE="${page_bundle}/page.css"
           FRUSTUM_PAGE_TEMPLATE="${page_template}")
