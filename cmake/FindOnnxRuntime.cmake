# FindOnnxRuntime: the network runtime of the stage `segment`; optional.
#
# Looked for in this order, header and library always from the same prefix:
#   1. -DONNXRUNTIME_ROOT=DIR or the environment's ONNXRUNTIME_ROOT (DIR/include and DIR/lib)
#   2. what the system has (CMAKE_PREFIX_PATH, /usr/local, /usr)
#   3. third_party/onnxruntime of this checkout (scripts/fetch_onnxruntime.sh)
# Defines OnnxRuntime_FOUND and the target OnnxRuntime::OnnxRuntime. Because the target names the library by its full
# path, programs in the build tree carry a run path to it.
set(_header_suffixes include include/onnxruntime include/onnxruntime/core/session)
set(_library_suffixes lib lib64 lib/${CMAKE_LIBRARY_ARCHITECTURE})

function(_find_onnxruntime_in prefix)
  find_path(_header onnxruntime_cxx_api.h PATHS ${prefix} PATH_SUFFIXES ${_header_suffixes} NO_DEFAULT_PATH NO_CACHE)
  find_library(_library NAMES onnxruntime libonnxruntime.so.1 PATHS ${prefix} PATH_SUFFIXES ${_library_suffixes}
               NO_DEFAULT_PATH NO_CACHE)
  if(_header AND _library)
    set(OnnxRuntime_INCLUDE_DIR ${_header} PARENT_SCOPE)
    set(OnnxRuntime_LIBRARY ${_library} PARENT_SCOPE)
  endif()
endfunction()

set(OnnxRuntime_INCLUDE_DIR "")
set(OnnxRuntime_LIBRARY "")
foreach(_root "${ONNXRUNTIME_ROOT}" "$ENV{ONNXRUNTIME_ROOT}")
  if(_root AND NOT OnnxRuntime_LIBRARY)
    _find_onnxruntime_in(${_root})
    if(NOT OnnxRuntime_LIBRARY)
      message(FATAL_ERROR "ONNXRUNTIME_ROOT is ${_root}, but there is no ONNX Runtime (include/onnxruntime_cxx_api.h "
                          "and lib/libonnxruntime.so)")
    endif()
  endif()
endforeach()
foreach(_prefix ${CMAKE_PREFIX_PATH} ${CMAKE_SYSTEM_PREFIX_PATH} ${PROJECT_SOURCE_DIR}/third_party/onnxruntime)
  if(NOT OnnxRuntime_LIBRARY)
    _find_onnxruntime_in(${_prefix})
  endif()
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(
  OnnxRuntime REQUIRED_VARS OnnxRuntime_LIBRARY OnnxRuntime_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "segment gets the engine of OpenCV only: scripts/fetch_onnxruntime.sh fetches ONNX Runtime")
if(OnnxRuntime_FOUND AND NOT TARGET OnnxRuntime::OnnxRuntime)
  add_library(OnnxRuntime::OnnxRuntime SHARED IMPORTED)
  set_target_properties(OnnxRuntime::OnnxRuntime PROPERTIES IMPORTED_LOCATION ${OnnxRuntime_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${OnnxRuntime_INCLUDE_DIR})
endif()
