# GPU strategies, a part of the library. AUTO builds them when nvcc is found; OFF leaves no trace of CUDA in the build. On a machine
# without a device or driver they build all the same and are listed as unavailable, with the reason.
catena_choice(CATENA_CUDA AUTO "GPU strategies" AUTO ON OFF)
set(CATENA_CUDA_ARCHITECTURES "" CACHE STRING "CUDA architectures; empty: native when a device is here, else 75, whose PTX suits every later one")

if(NOT CATENA_CUDA STREQUAL "OFF")
  find_program(CATENA_NVCC nvcc HINTS ENV CUDA_PATH ENV CUDA_HOME /usr/local/cuda PATH_SUFFIXES bin)
  if(CATENA_NVCC AND NOT CMAKE_CUDA_COMPILER)
    set(CMAKE_CUDA_COMPILER ${CATENA_NVCC})
  endif()
  if(NOT CATENA_NVCC AND CATENA_CUDA STREQUAL "ON")
    message(FATAL_ERROR "CATENA_CUDA=ON, but nvcc was not found; install the CUDA Toolkit or set CATENA_CUDA=AUTO")
  endif()
endif()

if(CATENA_NVCC AND NOT CATENA_CUDA STREQUAL "OFF")
  if(CATENA_CUDA_ARCHITECTURES)
    set(CMAKE_CUDA_ARCHITECTURES ${CATENA_CUDA_ARCHITECTURES})
  elseif(EXISTS /dev/nvidia0)
    set(CMAKE_CUDA_ARCHITECTURES native)
  else()
    set(CMAKE_CUDA_ARCHITECTURES 75)  # one pass: this build may never meet a device
  endif()
  enable_language(CUDA)
  file(GLOB sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/cuda/*.cu)
  add_library(catena_cuda OBJECT ${sources})
  target_link_libraries(catena_cuda PUBLIC catena_options)
  # How .cu files of a target are compiled. CMake 3.25 does not know C++20 for nvcc 13 and drops it in silence, so the
  # flag is written here and checked in cuda/call.h. Contraction is off: parents must have the host's bits.
  function(catena_compile_cuda target)
    set_target_properties(${target} PROPERTIES CUDA_STANDARD_REQUIRED OFF CUDA_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    target_compile_options(${target} PRIVATE
      $<$<COMPILE_LANGUAGE:CUDA>:-std=c++20 --fmad=false -Xcompiler=-Wall,-Wextra,-ffp-contract=off -lineinfo>)
  endfunction()
  catena_compile_cuda(catena_cuda)
  target_link_libraries(catena PRIVATE catena_cuda)
endif()
