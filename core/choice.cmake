# catena_choice(NAME DEFAULT DOC WORD...): a cache entry that is one of these words, however it is written: in capitals or
# not, and as CMake writes booleans, 0, FALSE or NO for OFF, 1, TRUE or YES for ON. Anything else is refused: what nobody
# compares with would pass for one of the words in one place, and for another elsewhere.
function(catena_choice name default doc)
  set(${name} ${default} CACHE STRING "${doc}")
  set_property(CACHE ${name} PROPERTY STRINGS ${ARGN})
  string(TOUPPER "${${name}}" word)
  if(word MATCHES "^(0|FALSE|NO|N)$")
    set(word OFF)
  elseif(word MATCHES "^(1|TRUE|YES|Y)$")
    set(word ON)
  endif()
  if(NOT word IN_LIST ARGN)
    list(JOIN ARGN ", " words)
    message(FATAL_ERROR "${name}=${${name}}: is none of ${words}")
  endif()
  set(${name} ${word} PARENT_SCOPE)
endfunction()
