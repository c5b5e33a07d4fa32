# The labels of the tests in catena_tests. ctest reads this file, so that presets, coverage.cmake and mutate_sources.py
# select by label alone. What is labelled is a suite (Sizes), an instantiation of suites (Device) or one test
# (Mutants.AllDie); a name that no test has is an error.
cmake_policy(VERSION 3.25)
if(NOT catena_tests_TESTS)
  return()  # not built
endif()

# Needs a device; skipped without one.
set(gpu Device DeviceBlocks DeviceCells DeviceGolden DeviceTrial)
if(CATENA_TESTS_OF_CUDA)  # said by tests.cmake: these are in no build without CUDA
  list(APPEND gpu DeviceLook DeviceMemory DeviceQueue)
endif()
# Of the host, and of a device where there is one: `ctest -L gpu` has them too.
set(gpu-too Cells)
# Not in the fast suite; `ctest --preset long`.
set(long SmallScopeLong SnakeLong StabilityLong SizesLong EnumerateLong LatticeBoxLong SecondArithmeticLong GrowthLong EndToEndLong)
set(golden Golden DeviceGolden)
# Simulates moving tubes at length; sanitizers make hours of it.
set(simulation SnakeProperty Yarn PulledRope.StretchesByThePullOverTheStiffness PulledRope.MovesTheSameBitsWithEveryExactVariant
    PulledRope.ShowsContactsThatAVariantDrops Rope.RepeatsTwoRopesAndKeepsTheOthersApart)
# Repeats on far more input what other tests execute already.
set(volume Sizes Flood Extremes)
# What several threads do, for ThreadSanitizer.
set(threads Threads HostGroup HostExecutor PairCollector)
# Which tests notice a mutant of the sources: seconds kill most, and only the others meet those that take a minute.
set(kills-in-seconds Golden Corpus Program Mutants.WithoutABugTheirBasePasses TreeShape Certificate Robust ExactSign Composed
    Work Level PairCollector)
set(kills-in-a-minute Mutants.WithoutABugTheirBasePassesLongChains Mutants.AllDie Extremes Flood Sizes)
# Take ten seconds or more, and start first: two at a time end together.
set(starts-first Sizes Extremes Flood Mutants Fuzzer.KillsEveryMutantWithinItsBudget Mpirun)

set(all_labels gpu gpu-too long golden simulation volume threads kills-in-seconds kills-in-a-minute starts-first)
set(used "")
foreach(test IN LISTS catena_tests_TESTS)
  set(labels "")
  foreach(label IN LISTS all_labels)
    foreach(name IN LISTS ${label})
      string(REPLACE "." "[.]" pattern "${name}")
      if("${test}" MATCHES "(^|/)${pattern}($|[./])")
        list(APPEND labels ${label})
        list(APPEND used ${label}:${name})
      endif()
    endforeach()
  endforeach()
  set_tests_properties("${test}" PROPERTIES LABELS "${labels}")
  if("starts-first" IN_LIST labels)
    set_tests_properties("${test}" PROPERTIES COST 30)
  endif()
  if("long" IN_LIST labels)
    set_tests_properties("${test}" PROPERTIES TIMEOUT 3600)
  endif()
endforeach()
foreach(label IN LISTS all_labels)
  foreach(name IN LISTS ${label})
    if(NOT "${label}:${name}" IN_LIST used)
      message(FATAL_ERROR "properties/labels.cmake: no test is named ${name}, which has the label ${label}")
    endif()
  endforeach()
endforeach()
