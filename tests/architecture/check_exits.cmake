# No thread ends the process (reliability.md R27): what ends one, what starts threads, and the libraries that
# may crash on damaged files or take one thread alone stand where they are named here and nowhere else.
cmake_policy(VERSION 3.20)
set(bad "")

# PATTERN may match a line of code in the files that WHERE matches, each of which exists and is needed.
function(only_in what pattern)
  set(allowed ${ARGN})
  set(found)
  file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/core/*.?pp ${ROOT}/mc/*.?pp ${ROOT}/analysis/*.?pp)
  foreach(file IN LISTS files)
    file(STRINGS ${ROOT}/${file} lines REGEX "${pattern}")
    list(FILTER lines EXCLUDE REGEX "^ *//")
    if(lines)
      list(APPEND found ${file})
      if(NOT file IN_LIST allowed)
        string(APPEND bad "${file}: ${what}: ${lines}\n")
      endif()
    endif()
  endforeach()
  foreach(file IN LISTS allowed)
    if(NOT file IN_LIST found)
      string(APPEND bad "tests/architecture/check_exits.cmake names ${file} for nothing: ${what}\n")
    endif()
  endforeach()
  set(bad "${bad}" PARENT_SCOPE)
endfunction()

# A child that reads a damaged file, a processor without the instructions, and the second stop signal.
only_in("ends the process" "(^|[^a-zA-Z0-9_.>])(_exit|_Exit|exit|quick_exit|abort|terminate)\\("
  core/recording/isolated.cpp core/base/processor/look.cpp mc/engine/stop_signals.cpp analysis/cli/stop_at_once.cpp)
# Both catch what a run throws within the thread that it was thrown in.
only_in("starts threads" "omp parallel|std::(j?thread|async)[^_]|pthread_create" mc/engine/engine.cpp mc/task/campaign.cpp)
foreach(file mc/engine/engine.cpp mc/task/campaign.cpp)
  file(STRINGS ${ROOT}/${file} guards REGEX "catch \\(\\.\\.\\.\\)")
  if(NOT guards)
    string(APPEND bad "${file}: starts threads and catches nothing in them\n")
  endif()
endforeach()
only_in("calls HDF5 or matio" "include <(hdf5|matio)"
  core/recording/hdf5_handle.hpp core/recording/recording_hdf5_write.cpp core/recording/recording_mat.cpp
  core/recording/recording_mat_write.cpp mc/export/hdf5_box.hpp mc/export/hdf5_output.cpp)
only_in("calls MPI" "include <mpi" mc/engine/mpi_launch.cpp)
if(bad)
  message(FATAL_ERROR "${bad}")
endif()
