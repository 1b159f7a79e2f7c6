#include "tools/report/page_text.hpp"

// The bundled file becomes part of the program as it is.
asm(".section .rodata\n"
    ".global sediment_page_begin\n"
    ".global sediment_page_end\n"
    "sediment_page_begin:\n"
    ".incbin \"" SEDIMENT_PAGE
    "\"\n"
    "sediment_page_end:\n"
    ".byte 0\n"
    ".text\n");

extern "C" const char sediment_page_begin[], sediment_page_end[];

namespace sediment::report {

std::string_view page_text() {
  return {sediment_page_begin, sediment_page_end};
}

}  // namespace sediment::report
