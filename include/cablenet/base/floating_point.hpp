#pragma once
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace cablenet {

/// Numbers below 2e-308 become zero on this thread, where the processor can: far from a disturbance a solution decays
/// to them, and they take a hundred times as long to compute with.
inline void flush_denormals() {
#if defined(__SSE2__)
  constexpr unsigned flush_results = 0x8000, flush_operands = 0x0040;
  _mm_setcsr(_mm_getcsr() | flush_results | flush_operands);
#endif
}

}   // namespace cablenet
