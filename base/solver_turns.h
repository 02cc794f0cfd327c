#pragma once

#include <dlfcn.h>

#include <mutex>

namespace base
{
  /**
   * Hold it while a sparse direct solver orders its unknowns: METIS draws from the process's one source of random numbers, which it sets at each
   * start, so two threads at once would disturb each other's order, and with it the bits.
   */
  inline std::unique_lock<std::mutex> ordering_turn()
  {
    static std::mutex one_at_a_time;
    return std::unique_lock<std::mutex>(one_at_a_time);
  }

  /** The OpenBLAS that this process has loaded, if any. */
  class LoadedOpenBlas
  {
  public:
    /** One thread for each caller: its own threads, where it has some, would change the bits with their number. */
    void use_one_thread() const
    {
      if (const auto set = function<void(int)>("openblas_set_num_threads"))
        set(1);
    }
    /** The build without threads shares its buffers among callers without any lock: two at once get wrong numbers now and then. */
    bool takes_one_caller() const
    {
      const auto kind = function<int()>("openblas_get_parallel");
      return kind && kind() == 0;
    }

  private:
    template <typename Signature>
    Signature *function(const char *const name) const
    {
      return library ? reinterpret_cast<Signature *>(::dlsym(library, name)) : nullptr;
    }

    void *library = ::dlopen("libopenblas.so.0", RTLD_LAZY | RTLD_NOLOAD);
  };

  /** Hold it while a sparse direct solver factorises or solves, which calls the BLAS. Other libraries than OpenBLAS keep no state: threads go on side by side. */
  inline std::unique_lock<std::mutex> dense_kernels_turn()
  {
    static std::mutex one_at_a_time;
    static const bool in_turn = [] {
      const LoadedOpenBlas openblas;
      openblas.use_one_thread();
      return openblas.takes_one_caller();
    }();
    return in_turn ? std::unique_lock<std::mutex>(one_at_a_time) : std::unique_lock<std::mutex>();
  }
} // namespace base
