find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt 9 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(yaml-cpp 0.7 REQUIRED)
find_package(tinyxml2 REQUIRED)
find_package(CLI11 2.1 REQUIRED)
find_package(Threads REQUIRED)

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
