# Writes a version script for the linker: what a shared library of ours shows.
#
#   cmake -DINCLUDE=FOLDER -DOUTPUT=FILE [-DPRIVATE=NAME;NAME] -P promised_names.cmake
#
# Shown is what the headers under INCLUDE declare in namespace limpid, with its members, and the
# functions of the C header. The rest stays inside: what other headers declare, inner namespaces,
# other libraries' templates, the standard library's. PRIVATE: names that are shown besides, to our
# own libraries alone, and may change at any time; they have a version of their own.
#
# The headers are formatted: what begins in the first column is declared in a namespace. A mangled
# name has the length of each of its parts before it, so that a pattern fits one name alone.

cmake_minimum_required(VERSION 3.25)

# Patterns for NAME of namespace limpid, and of its namespace detail, which public templates use:
# functions and members, what is known of types, thunks, guards of static members.
function(patterns_of name result)
  string(LENGTH ${name} length)
  set(patterns "")
  foreach(scope limpid limpid6detail)
    set(mangled 6${scope}${length}${name}*)
    foreach(kind _ZN _ZNK _ZTIN _ZTSN _ZTVN _ZTTN _ZGVN)
      string(APPEND patterns "    ${kind}${mangled};\n")
    endforeach()
    string(APPEND patterns "    _ZT[hvc]*_N${mangled};\n    _ZT[hvc]*_NK${mangled};\n")
  endforeach()
  set(${result} "${patterns}" PARENT_SCOPE)
endfunction()

set(declared "")
file(GLOB_RECURSE headers ${INCLUDE}/*.h)
foreach(header ${headers})
  file(READ ${header} text)
  string(REGEX MATCHALL "\n(struct|class|enum class) [A-Za-z_0-9]+[^A-Za-z_0-9;]" types "${text}")
  string(REGEX MATCHALL "\n[A-Za-z][^\n(;=#/]*[ *&][A-Za-z_][A-Za-z_0-9]*\\(" functions "${text}")
  foreach(found ${types} ${functions})
    string(REGEX MATCH "([A-Za-z_0-9]+)[^A-Za-z_0-9]$" name "${found}")
    list(APPEND declared ${CMAKE_MATCH_1})
  endforeach()
endforeach()
list(FILTER declared EXCLUDE REGEX "^limpid_")
list(SORT declared)
list(REMOVE_DUPLICATES declared)
if(NOT "Look" IN_LIST declared OR NOT "make_plan" IN_LIST declared)
  message(FATAL_ERROR "${INCLUDE}: not the headers of limpid")
endif()

set(promised "")
foreach(name ${declared})
  patterns_of(${name} patterns)
  string(APPEND promised "${patterns}")
endforeach()
set(script "LIMPID {\n  global:\n    limpid_*;\n${promised}  local:\n    *;\n};\n")
if(PRIVATE)
  set(shared "")
  foreach(name ${PRIVATE})
    patterns_of(${name} patterns)
    string(APPEND shared "${patterns}")
  endforeach()
  string(APPEND script "LIMPID_PRIVATE {\n  global:\n${shared}};\n")
endif()
file(WRITE ${OUTPUT} "${script}")
