# Finds what we build on. LCM has no CMake package; PCL's would pull in VTK and Qt, of which we use
# nothing, so both are found by name, as targets of their own.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Protobuf REQUIRED)
find_package(GTest REQUIRED)
find_package(PNG REQUIRED)
find_package(Threads REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(OpenMP REQUIRED)
find_package(benchmark REQUIRED)

find_path(LCM_INCLUDE_DIR lcm/lcm.h REQUIRED)
find_library(LCM_LIBRARY lcm REQUIRED)
find_program(LCM_GEN lcm-gen REQUIRED)
add_library(lcm INTERFACE)
target_include_directories(lcm SYSTEM INTERFACE ${LCM_INCLUDE_DIR})
target_link_libraries(lcm INTERFACE ${LCM_LIBRARY})

find_path(ZSTD_INCLUDE_DIR zstd.h REQUIRED)
find_library(ZSTD_LIBRARY zstd REQUIRED)
add_library(zstd INTERFACE)
target_include_directories(zstd SYSTEM INTERFACE ${ZSTD_INCLUDE_DIR})
target_link_libraries(zstd INTERFACE ${ZSTD_LIBRARY})

find_path(TURBOJPEG_INCLUDE_DIR turbojpeg.h REQUIRED)
find_library(TURBOJPEG_LIBRARY turbojpeg REQUIRED)
add_library(turbojpeg INTERFACE)
target_include_directories(turbojpeg SYSTEM INTERFACE ${TURBOJPEG_INCLUDE_DIR})
target_link_libraries(turbojpeg INTERFACE ${TURBOJPEG_LIBRARY})

# OpenNI2 loads its drivers from the folder OpenNI2/Drivers beside its library. A folder of our own
# holds a link to the library and to each installed driver, so that our driver is found without
# being installed. The dummy device of Debian's package crashes most programs that load it.
find_path(OPENNI_INCLUDE_DIR OpenNI.h PATH_SUFFIXES openni2 REQUIRED)
find_library(OPENNI_LIBRARY OpenNI2 REQUIRED)
set(OPENNI_FOLDER ${CMAKE_BINARY_DIR}/openni2)
set(OPENNI_DRIVER_FOLDER ${OPENNI_FOLDER}/OpenNI2/Drivers)
get_filename_component(installed_folder ${OPENNI_LIBRARY} DIRECTORY)
file(GLOB installed_drivers ${installed_folder}/OpenNI2/Drivers/lib*.so.0)
list(FILTER installed_drivers EXCLUDE REGEX "libDummyDevice")
file(MAKE_DIRECTORY ${OPENNI_DRIVER_FOLDER})
foreach(driver ${installed_drivers})
  get_filename_component(file_name ${driver} NAME)
  file(CREATE_LINK ${driver} ${OPENNI_DRIVER_FOLDER}/${file_name} SYMBOLIC)
endforeach()
file(CREATE_LINK ${installed_folder}/libOpenNI2.so.0 ${OPENNI_FOLDER}/libOpenNI2.so.0 SYMBOLIC)
add_library(openni2 SHARED IMPORTED)
set_target_properties(openni2 PROPERTIES
  IMPORTED_LOCATION ${OPENNI_FOLDER}/libOpenNI2.so.0 IMPORTED_SONAME libOpenNI2.so.0)
target_include_directories(openni2 SYSTEM INTERFACE ${OPENNI_INCLUDE_DIR})

find_path(PCL_INCLUDE_DIR pcl/point_types.h PATH_SUFFIXES pcl-1.13 pcl-1.12 pcl REQUIRED)
foreach(component common io kdtree search features filters segmentation sample_consensus surface)
  find_library(PCL_${component}_LIBRARY pcl_${component} REQUIRED)
  add_library(pcl_${component} INTERFACE)
  target_include_directories(pcl_${component} SYSTEM INTERFACE ${PCL_INCLUDE_DIR})
  target_link_libraries(pcl_${component} INTERFACE ${PCL_${component}_LIBRARY} Eigen3::Eigen)
endforeach()
