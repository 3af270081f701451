#pragma once
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace cablenet {

/// Makes this thread round numbers below 2e-308 to zero, if the processor can.  Far from a disturbance a solution
/// decays to such numbers, and arithmetic on them takes a hundred times as long.
inline void flush_denormals() {
#if defined(__SSE2__)
  constexpr unsigned flush_results = 0x8000, flush_operands = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_results | flush_operands);
#endif
}

}   // namespace cablenet
