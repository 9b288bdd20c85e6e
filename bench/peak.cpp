// What a core can do with its registers full of independent numbers, one line of three: 1e9 per second of multiplications and additions in
// equal parts, of divisions, of square roots. Each is the best of eleven runs.
//
//   peak [sse2|avx2|avx512]      with registers of that instruction set; avx2 if not told
#include <immintrin.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>

namespace {

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

constexpr int runs = 11;

template <class Work>
double best_of(Work&& work) {
  double best = 1e300;
  for (int k = 0; k < runs; ++k) {
    const double start = seconds();
    work();
    best = std::min(best, seconds() - start);
  }
  return best;
}

constexpr int turns = 100000, chains = 12;

// Twelve registers, one after the other, each kept from the optimiser by an empty asm: the loops do what is written and nothing else, and
// twelve independent chains hide the latency.
#define ABUT_KEEP(a) asm volatile("" : "+x"(a))
#define ABUT_TWELVE(even, odd) even(a0) odd(a1) even(a2) odd(a3) even(a4) odd(a5) even(a6) odd(a7) even(a8) odd(a9) even(a10) odd(a11)
#define ABUT_LOOP(real, count, even, odd)                                                                                      \
  real a0 = real{} + 1.1, a1 = a0, a2 = a0, a3 = a0, a4 = a0, a5 = a0, a6 = a0, a7 = a0, a8 = a0, a9 = a0, a10 = a0, a11 = a0; \
  ABUT_TWELVE(ABUT_KEEP_AND_END, ABUT_KEEP_AND_END)                                                                            \
  for (int i = 0; i < (count); ++i) { ABUT_TWELVE(even, odd) }
#define ABUT_KEEP_AND_END(a) ABUT_KEEP(a);
#define ABUT_MULTIPLY(a) \
  a = a * m;             \
  ABUT_KEEP(a);
#define ABUT_ADD(a) \
  a = a + c;        \
  ABUT_KEEP(a);
#define ABUT_DIVIDE(a) \
  a = m / a;           \
  ABUT_KEEP(a);
#define ABUT_PEAK(isa, target_name, width)                             \
  typedef double Real_##isa __attribute__((vector_size(8 * (width)))); \
  __attribute__((target(target_name))) void multiply_add_##isa() {     \
    Real_##isa m = Real_##isa{} + 0.999999, c = Real_##isa{} + 1e-9;   \
    ABUT_LOOP(Real_##isa, turns, ABUT_MULTIPLY, ABUT_ADD)              \
  }                                                                    \
  __attribute__((target(target_name))) void divide_##isa() {           \
    Real_##isa m = Real_##isa{} + 1.7;                                 \
    ABUT_LOOP(Real_##isa, turns / 8, ABUT_DIVIDE, ABUT_DIVIDE)         \
  }                                                                    \
  __attribute__((target(target_name))) void root_##isa() { ABUT_LOOP(Real_##isa, turns / 8, ABUT_ROOT_STEP_##isa, ABUT_ROOT_STEP_##isa) }
#define ABUT_ROOT_STEP_sse2(a)              \
  a = (Real_sse2)_mm_sqrt_pd((__m128d)(a)); \
  ABUT_KEEP(a);
#define ABUT_ROOT_STEP_avx2(a)                 \
  a = (Real_avx2)_mm256_sqrt_pd((__m256d)(a)); \
  ABUT_KEEP(a);
#define ABUT_ROOT_STEP_avx512(a)                             \
  a = (Real_avx512)_mm512_maskz_sqrt_pd(0xff, (__m512d)(a)); \
  ABUT_KEEP(a);
ABUT_PEAK(sse2, "sse2", 2)
ABUT_PEAK(avx2, "avx2", 4)
ABUT_PEAK(avx512, "avx512f,avx512dq", 8)

struct Peak {
  void (*multiply_add)();
  void (*divide)();
  void (*root)();
  int width;
};

Peak peak_of(const std::string& isa) {
  if (isa == "sse2") return {multiply_add_sse2, divide_sse2, root_sse2, 2};
  if (isa == "avx512") return {multiply_add_avx512, divide_avx512, root_avx512, 8};
  return {multiply_add_avx2, divide_avx2, root_avx2, 4};
}

}  // namespace

int main(int argc, char** argv) {
  const Peak peak = peak_of(argc > 1 ? argv[1] : "avx2");
  const double all = 1e-9 * peak.width * chains * turns;
  std::printf("%.2f %.3f %.3f\n", all / best_of(peak.multiply_add), all / 8 / best_of(peak.divide), all / 8 / best_of(peak.root));
  return 0;
}
