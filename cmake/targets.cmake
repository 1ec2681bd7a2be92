# add_parameters(NAME FILE.proto... [SHARED] [DEPENDS other...]): a library of the generated classes.
# Generated code is compiled without our warnings and included as system headers. SHARED: also for
# what a process loads while it runs, since its types may be registered only once in a process.
function(add_parameters name)
  cmake_parse_arguments(ARG "SHARED" "" "DEPENDS" ${ARGN})
  set(out ${CMAKE_BINARY_DIR}/generated/proto)
  file(MAKE_DIRECTORY ${out})
  set(sources)
  foreach(proto ${ARG_UNPARSED_ARGUMENTS})
    file(RELATIVE_PATH path ${CMAKE_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${proto})
    string(REGEX REPLACE "\\.proto$" "" stem ${path})
    add_custom_command(
      OUTPUT ${out}/${stem}.pb.cc ${out}/${stem}.pb.h
      COMMAND protobuf::protoc --cpp_out=${out} -I${CMAKE_SOURCE_DIR} -I/usr/include
              ${CMAKE_SOURCE_DIR}/${path}
      DEPENDS ${CMAKE_SOURCE_DIR}/${path} ${CMAKE_SOURCE_DIR}/modules/runtime/parameter.proto)
    list(APPEND sources ${out}/${stem}.pb.cc ${out}/${stem}.pb.h)
  endforeach()
  if(ARG_SHARED)
    add_library(${name} SHARED ${sources})
  else()
    add_library(${name} STATIC ${sources})
  endif()
  target_compile_options(${name} PRIVATE -w)
  target_include_directories(${name} SYSTEM PUBLIC ${out})
  target_link_libraries(${name} PUBLIC protobuf::libprotobuf ${ARG_DEPENDS})
endfunction()

# add_core(NAME [LINK library...] [TEST_LINK library...]): the library of this folder, from all its
# .cpp files but main.cpp, and its unit tests, one program from all *_test.cpp.
function(add_core name)
  cmake_parse_arguments(ARG "" "" "LINK;TEST_LINK" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  file(GLOB tests CONFIGURE_DEPENDS *_test.cpp)
  list(FILTER sources EXCLUDE REGEX "(main|_test)\\.cpp$")
  add_library(${name} STATIC ${sources})
  target_include_directories(${name} PUBLIC ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PUBLIC ${ARG_LINK})
  if(tests)
    add_executable(${name}_test ${tests})
    target_link_libraries(${name}_test PRIVATE ${name} ${ARG_TEST_LINK} GTest::gmock GTest::gtest_main)
    add_test(NAME ${name} COMMAND ${name}_test)
    set_tests_properties(${name} PROPERTIES LABELS unit)
  endif()
endfunction()

# add_module(NAME [LINK library...] [TEST_LINK library...]): a process of the graph: its parameters
# (NAME.proto), its core (NAME_core, no LCM) and its program (main.cpp).
function(add_module name)
  cmake_parse_arguments(ARG "" "" "LINK;TEST_LINK" ${ARGN})
  add_parameters(${name}_parameters ${name}.proto DEPENDS parameter)
  add_core(${name}_core LINK geometry ${name}_parameters ${ARG_LINK} TEST_LINK ${ARG_TEST_LINK})
  if(EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/main.cpp)
    add_executable(${name} main.cpp)
    target_link_libraries(${name} PRIVATE ${name}_core codec runtime)
  endif()
endfunction()
