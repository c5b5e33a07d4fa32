/// What ThreadSanitizer leaves out in the test programs of threads: calls that oneTBB itself makes. Debian's is not
/// built for it, so how its threads agree on freeing its own mask of cores at exit is not seen, and reported as a race.
/// Ranges that run on its threads are ours, and stay looked at: their frames make their own calls.
extern "C" const char* __tsan_default_suppressions();
extern "C" const char* __tsan_default_suppressions() { return "called_from_lib:libtbb.so\n"; }
