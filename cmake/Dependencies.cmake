find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(xsimd 8.1 REQUIRED)
find_package(fmt 9 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(OpenSSL REQUIRED)
find_package(Threads REQUIRED)
find_package(Boost 1.74 REQUIRED)  # headers only

# MuJoCo's own package file on Debian asks for OpenGL and Qhull headers that dynamics does not
# need, so the library is found directly.
find_path(MUJOCO_INCLUDE_DIR mujoco/mujoco.h REQUIRED)
find_library(MUJOCO_LIBRARY mujoco REQUIRED)
add_library(mujoco_library UNKNOWN IMPORTED)
set_target_properties(mujoco_library PROPERTIES IMPORTED_LOCATION ${MUJOCO_LIBRARY}
                      INTERFACE_INCLUDE_DIRECTORIES ${MUJOCO_INCLUDE_DIR})

find_path(UDUNITS_INCLUDE_DIR udunits2.h REQUIRED)
find_library(UDUNITS_LIBRARY udunits2 REQUIRED)
add_library(udunits_library UNKNOWN IMPORTED)
set_target_properties(udunits_library PROPERTIES IMPORTED_LOCATION ${UDUNITS_LIBRARY}
                      INTERFACE_INCLUDE_DIRECTORIES ${UDUNITS_INCLUDE_DIR})

# For writing trajectories; Debian's package file of it lists every library it was itself built with.
if(TWINCRAFT_NETCDF)
  find_path(NETCDF_INCLUDE_DIR netcdf_mem.h REQUIRED)
  find_library(NETCDF_LIBRARY netcdf REQUIRED)
  add_library(netcdf_library UNKNOWN IMPORTED)
  set_target_properties(netcdf_library PROPERTIES IMPORTED_LOCATION ${NETCDF_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${NETCDF_INCLUDE_DIR})
endif()

# What reports show their figures with. Debian's builds; the terms lie in the package's documentation.
find_path(DYGRAPHS_FOLDER dygraph.min.js PATHS /usr/share/javascript/dygraphs REQUIRED)
find_path(THREE_FOLDER build/three.min.js PATHS /usr/share/javascript/three REQUIRED)
find_file(DYGRAPHS_LICENCE copyright PATHS /usr/share/doc/libjs-dygraphs NO_DEFAULT_PATH REQUIRED)
find_file(THREE_LICENCE copyright PATHS /usr/share/doc/libjs-three NO_DEFAULT_PATH REQUIRED)
