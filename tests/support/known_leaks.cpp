// TBB frees what it keeps of an observer when the last thread that saw it comes by again; at the
// end of a program that may be never.
extern "C" const char* __lsan_default_suppressions();  // NOLINT(bugprone-reserved-identifier)
extern "C" const char* __lsan_default_suppressions() { return "leak:tbb::detail::r1::observe\n"; }
