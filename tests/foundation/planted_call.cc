// What hot_loops.sh must find: a kernel in which a call was left.
namespace dem
{
  [[gnu::noinline]] double left_as_a_call(const double x)
  {
    asm volatile("" ::: "memory");
    return x * x;
  }

  template <int n>
  [[gnu::noinline]] double particle_pass(const double *x)
  {
    double sum = 0;
    for (int i = 0; i < n; ++i)
      sum += left_as_a_call(x[i]);
    return sum;
  }

  template double particle_pass<3>(const double *);
} // namespace dem
