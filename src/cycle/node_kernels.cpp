#include "cycle/node_kernels.hpp"

#include "simd/isa.hpp"

namespace abut::cycle {

// node_kernels.isa.cpp, once per instruction set
#define ABUT_DECLARE_NODE_KERNELS(isa)                                       \
  namespace isa {                                                            \
  void assemble_nodes(const AssembleArgs&, std::size_t, std::size_t);        \
  void limit_nodes(const LimitArgs&, std::size_t, std::size_t, LimitLeaf&);  \
  void sum_nodes(const MotionArgs&, std::size_t, std::size_t, KineticLeaf&); \
  void integrate_nodes(const MotionArgs&, std::size_t, std::size_t);         \
  }                                                                          \
  static constexpr NodeKernels isa##_kernels{isa::assemble_nodes, isa::limit_nodes, isa::sum_nodes, isa::integrate_nodes};
ABUT_DECLARE_NODE_KERNELS(sse2)
ABUT_DECLARE_NODE_KERNELS(avx2)
ABUT_DECLARE_NODE_KERNELS(avx512)
#undef ABUT_DECLARE_NODE_KERNELS

const NodeKernels& node_kernels() { return *simd::of_active_isa(&sse2_kernels, &avx2_kernels, &avx512_kernels); }

}  // namespace abut::cycle
