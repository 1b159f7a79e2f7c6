/* Linked into every program that looks for leaks: these libraries keep memory to the end of the program on purpose. */
const char* __lsan_default_suppressions(void);
const char* __lsan_default_suppressions(void) {
  return "leak:libonnxruntime\nleak:libopencv\nleak:libtbb\nleak:libOpenCL\n";
}
