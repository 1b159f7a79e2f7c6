# Every third-party package and what it is for. All but ONNX Runtime come from Debian 12.
# Our layers link the narrow interface targets defined here, so that a binary loads only what it uses.
find_package(OpenCV 4.5 REQUIRED COMPONENTS core imgproc imgcodecs features2d calib3d flann video dnn)  # images, ORB, PnP
find_package(octomap REQUIRED)          # octree files that octovis and ROS open
find_package(Eigen3 3.4 REQUIRED NO_MODULE)  # linear algebra
find_package(Ceres REQUIRED)            # bundle adjustment
find_package(yaml-cpp REQUIRED)         # pipelines, sequences, labels
find_package(TBB REQUIRED)              # threads
find_package(nlohmann_json REQUIRED)    # contract, metrics, manifests
find_package(CLI11 REQUIRED)            # flags
find_package(spdlog REQUIRED)           # logs (brings fmt)

# PCL: its PCD files and its reference filters in tests and benchmarks. find_package(PCL) drags VTK in;
# only these four libraries are wanted.
find_path(PCL_ROOT_INCLUDE pcl/pcl_config.h PATH_SUFFIXES pcl-1.14 pcl-1.13 pcl-1.12 REQUIRED)
find_library(PCL_COMMON_LIBRARY pcl_common REQUIRED)
find_library(PCL_IO_LIBRARY pcl_io REQUIRED)
find_library(PCL_FILTERS_LIBRARY pcl_filters REQUIRED)
find_library(PCL_SEARCH_LIBRARY pcl_search REQUIRED)
find_library(PCL_KDTREE_LIBRARY pcl_kdtree REQUIRED)
find_package(Boost REQUIRED)

add_library(sediment_pcl_io INTERFACE)
target_include_directories(sediment_pcl_io SYSTEM INTERFACE ${PCL_ROOT_INCLUDE})
target_link_libraries(sediment_pcl_io INTERFACE ${PCL_IO_LIBRARY} ${PCL_COMMON_LIBRARY} Eigen3::Eigen Boost::headers)
# As it is where PCL was compiled: what its libraries allocate, Eigen frees here. Eigen would do otherwise under a sanitizer.
target_compile_definitions(sediment_pcl_io INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)

add_library(sediment_pcl_filters INTERFACE)
target_link_libraries(sediment_pcl_filters INTERFACE sediment_pcl_io ${PCL_FILTERS_LIBRARY} ${PCL_SEARCH_LIBRARY}
                      ${PCL_KDTREE_LIBRARY})

add_library(sediment_octomap INTERFACE)
target_include_directories(sediment_octomap SYSTEM INTERFACE ${OCTOMAP_INCLUDE_DIRS})
target_link_libraries(sediment_octomap INTERFACE ${OCTOMAP_LIBRARIES})
target_compile_definitions(sediment_octomap INTERFACE OCTOMAP_NODEBUGOUT)  # else it talks on stderr

# One interface target per OpenCV module, with the headers marked as the system's.
foreach(module core imgproc imgcodecs features2d calib3d flann video dnn)
  add_library(sediment_cv_${module} INTERFACE)
  target_include_directories(sediment_cv_${module} SYSTEM INTERFACE ${OpenCV_INCLUDE_DIRS})
  target_link_libraries(sediment_cv_${module} INTERFACE opencv_${module})
endforeach()

find_path(XXHASH_INCLUDE xxhash.h REQUIRED)  # XXH3-128 digests
find_library(XXHASH_LIBRARY xxhash REQUIRED)
add_library(sediment_xxhash INTERFACE)
target_include_directories(sediment_xxhash SYSTEM INTERFACE ${XXHASH_INCLUDE})
target_link_libraries(sediment_xxhash INTERFACE ${XXHASH_LIBRARY})

find_path(LIBDEFLATE_INCLUDE libdeflate.h REQUIRED)  # reading and writing PNG files
find_library(LIBDEFLATE_LIBRARY deflate REQUIRED)
add_library(sediment_libdeflate INTERFACE)
target_include_directories(sediment_libdeflate SYSTEM INTERFACE ${LIBDEFLATE_INCLUDE})
target_link_libraries(sediment_libdeflate INTERFACE ${LIBDEFLATE_LIBRARY})

find_package(OnnxRuntime)  # networks; optional: OpenCV's dnn is the fall-back
