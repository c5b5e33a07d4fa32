#pragma once
#include "catena/core/compiled_for.h"

/// Marks what libcatena.so shows to other programs: classes with members in its .cpp files, interfaces and
/// exceptions that pass its border in either direction, and the types of their members. All else is hidden in
/// it: what a program compiles of the same headers with flags of its own never takes the place of the
/// library's.
#define CATENA_API [[gnu::visibility("default")]]
