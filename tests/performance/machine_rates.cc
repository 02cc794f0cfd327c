#include "machine_rates.h"

#include "base/column.h"
#include "dem/core/simd.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <ctime>
#include <limits>

namespace performance
{
  namespace
  {
    constexpr int         repetitions = 5;
    constexpr std::size_t doubles     = std::size_t(1) << 25; // 256 MiB a column: far past any cache

    /** Processor time of one thread, which other programs blur less; of several the time that passes. */
    template <typename Work>
    double best_seconds(const int threads, Work &&work)
    {
      const auto now = [threads] {
        return threads == 1 ? static_cast<double>(std::clock()) / CLOCKS_PER_SEC :
                              std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
      };
      double best = std::numeric_limits<double>::infinity();
      for (int i = 0; i < repetitions; ++i)
        {
          const double start = now();
          work();
          best = std::min(best, now() - start);
        }
      return best;
    }

    volatile double sink; // keeps results alive
  }                       // namespace

  double triad_bandwidth(const int threads)
  {
    base::Column a(doubles, 0.0), b(doubles, 1.0), c(doubles, 2.0);
    double      *to = a.data(), *x = b.data(), *y = c.data();
    const double seconds = best_seconds(threads, [&] {
#pragma omp          parallel for num_threads(threads) schedule(static)
      for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(doubles); i += dem::pack_size)
        dem::store(dem::load(x + i) + dem::Pack(3.0) * dem::load(y + i), to + i);
    });
             sink = a[doubles / 2];
             return 3.0 * sizeof(double) * doubles / seconds;
           }

           double read_bandwidth(const int threads)
           {
             const base::Column a(doubles, 1.0);
             const double      *x       = a.data();
             double             total   = 0;
             const double       seconds = best_seconds(threads, [&] {
         #pragma omp parallel num_threads(threads) reduction(+ : total)
      {
                 dem::Pack sum[4] = {0.0, 0.0, 0.0, 0.0};
#pragma omp for schedule(static)
        for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(doubles); i += 4 * dem::pack_size)
          for (int k = 0; k < 4; ++k)
            sum[k] += dem::load(x + i + k * dem::pack_size);
        total += dem::sum_of(sum[0] + sum[1] + sum[2] + sum[3]);
               }
    });
             sink = total;
             return sizeof(double) * doubles / seconds;
           }

           double arithmetic_rate(const int threads)
           {
             constexpr int  chains  = 12; // enough to hide the latency of a fused multiply-add
             constexpr long rounds  = 20'000'000;
             double         total   = 0;
             const double   seconds = best_seconds(threads, [&] {
#pragma omp parallel num_threads(threads) reduction(+ : total)
      {
        dem::Pack x[chains];
        for (int k = 0; k < chains; ++k)
          x[k] = dem::Pack(1.0 + 1e-3 * k);
        const dem::Pack factor(0.999999), addend(1e-6);
        for (long i = 0; i < rounds / chains; ++i)
          for (int k = 0; k < chains; ++k)
            x[k] = multiply_add(x[k], factor, addend);
        for (int k = 0; k < chains; ++k)
          total += dem::sum_of(x[k]);
      }
    });
    sink = total;
    return 2.0 * dem::pack_size * static_cast<double>(rounds / chains * chains) * threads / seconds;
  }
} // namespace performance
