# Libraries from the distribution; scripts/setup installs them all. Nothing is downloaded here.
#
# What the static libraries need at link time is repeated in FrustumConfig.cmake.in for those who use an
# installed Frustum.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)   # Eigen3::Eigen
find_package(fmt 9 REQUIRED)                  # fmt::fmt
find_package(nlohmann_json 3.11 REQUIRED)     # nlohmann_json::nlohmann_json
find_package(tomlplusplus 3.3 REQUIRED)       # tomlplusplus::tomlplusplus
find_package(TBB REQUIRED)                    # TBB::tbb
find_package(Boost 1.74 REQUIRED)             # Boost::headers
find_package(CLI11 REQUIRED)                  # CLI11::CLI11
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)  # OpenSSL::Crypto
find_package(PNG 1.6 REQUIRED)                # PNG::PNG
find_package(ZLIB REQUIRED)                   # ZLIB::ZLIB
find_package(pugixml 1.12 REQUIRED)            # pugixml::pugixml
find_package(OpenMesh CONFIG REQUIRED)        # OpenMeshCore
find_package(embree 3.13 REQUIRED)            # embree
find_package(PkgConfig REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5)  # PkgConfig::HDF5, whose CMake module needs C
pkg_check_modules(HTTPLIB REQUIRED cpp-httplib)  # for one source of app/
find_package(MPI COMPONENTS CXX)              # MPI::MPI_CXX, where there is one: studies on a cluster
find_path(FRUSTUM_RANDOM123_INCLUDE Random123/philox.h REQUIRED)

if(FRUSTUM_WITH_CGAL)
  set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE)
  find_package(CGAL 5.5 REQUIRED)             # CGAL::CGAL
endif()

# An optional component: who has no OpenCASCADE (scripts/setup --with-step) gets everything else.
if(FRUSTUM_WITH_STEP)
  find_package(OpenCASCADE QUIET CONFIG
               COMPONENTS FoundationClasses ModelingData ModelingAlgorithms Visualization ApplicationFramework
                          DataExchange)  # TKSTEP, TKMesh; the others are what these name
  if(OpenCASCADE_FOUND AND OpenCASCADE_VERSION VERSION_LESS 7.6) # a version in the call would have to be equal
    message(STATUS "OpenCASCADE ${OpenCASCADE_VERSION} is older than 7.6: STEP files are not read")
    set(OpenCASCADE_FOUND OFF)
  endif()
endif()
