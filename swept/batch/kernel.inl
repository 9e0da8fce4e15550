// What a pair's file says once for every target (THINWALL_BATCH_TARGET, inside HWY_NAMESPACE) and once in all (THINWALL_BATCH_RUN):
// run<ItemA, ItemB> of float and double. NAME keeps the files of one library apart.

#ifndef THINWALL_BATCH_TARGET
#define THINWALL_BATCH_TARGET(NAME, Kernel)                                                       \
  HWY_ATTR std::size_t NAME##_double(const Rows<double>& a, const Rows<double>& b, std::size_t n, \
                                     const Answers<double>& out) {                                \
    return run_target<Kernel>(a, b, n, out);                                                      \
  }                                                                                               \
  HWY_ATTR std::size_t NAME##_float(const Rows<float>& a, const Rows<float>& b, std::size_t n,    \
                                    const Answers<float>& out) {                                  \
    return run_target<Kernel>(a, b, n, out);                                                      \
  }

#define THINWALL_BATCH_RUN_OF(NAME, S, ...)                                                                            \
  HWY_EXPORT(NAME##_##S);                                                                                              \
  template <> std::size_t run<__VA_ARGS__>(const Rows<S>& a, const Rows<S>& b, std::size_t n, const Answers<S>& out) { \
    return HWY_DYNAMIC_DISPATCH(NAME##_##S)(a, b, n, out);                                                             \
  }
#endif
