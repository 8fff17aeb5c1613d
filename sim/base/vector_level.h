// Which width of vectors this processor has. Hot loops are compiled for each width from one source,
// with the same operations in the same order (no fused multiply-add), so that all give the same
// bytes.
#pragma once

namespace dodgesim {

enum VectorLevel { kPortable = 0, kAvx2 = 1, kAvx512 = 2 };
inline constexpr int kVectorLevels = 3;

inline int widest_vector_level() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    return kAvx512;
  }
  if (__builtin_cpu_supports("avx2")) return kAvx2;
#endif
  return kPortable;
}

// The widest, or what the environment variable DODGESIM_VECTORS names: portable, avx2 or avx512.
// Throws ScenarioError if this processor has no such vectors.
int vector_level();

#if defined(__x86_64__)
#define DODGESIM_TARGET_AVX2 [[gnu::target("avx2")]]
#if defined(__clang__)  // ignores the attribute if it names a preferred width
#define DODGESIM_TARGET_AVX512 [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl")]]
#else
#define DODGESIM_TARGET_AVX512 \
  [[gnu::target("avx512f,avx512bw,avx512dq,avx512vl,prefer-vector-width=512")]]
#endif
#else
#define DODGESIM_TARGET_AVX2
#define DODGESIM_TARGET_AVX512
#endif

// A loop, which must be an always_inline function, compiled for each width.
template <auto kLoop>
struct CompiledLoop;
template <class Result, class... Arguments, Result (*kLoop)(Arguments...)>
struct CompiledLoop<kLoop> {
  static Result portable(Arguments... arguments) { return kLoop(arguments...); }
  DODGESIM_TARGET_AVX2 static Result avx2(Arguments... arguments) { return kLoop(arguments...); }
  DODGESIM_TARGET_AVX512 static Result avx512(Arguments... arguments) {
    return kLoop(arguments...);
  }
};

// A pointer to the loop as compiled for the level.
template <auto kLoop>
constexpr auto compiled_for(int vector_level) {
  using Loop = CompiledLoop<kLoop>;
  if (vector_level == kAvx512) return Loop::avx512;
  return vector_level == kAvx2 ? Loop::avx2 : Loop::portable;
}

}  // namespace dodgesim
