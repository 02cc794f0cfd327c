// Several libraries bring a BLAS of their own (Ceres: ATLAS). The first one that is loaded answers all.
#include <catch2/catch.hpp>

#include <cholmod.h>
#include <dlfcn.h>

#include <filesystem>

namespace
{
  std::filesystem::path folder_of(void *const symbol)
  {
    Dl_info found;
    REQUIRE(dladdr(symbol, &found));
    return std::filesystem::canonical(found.dli_fname).parent_path();
  }
} // namespace

TEST_CASE("CHOLMOD's dense kernels are those of the system's libblas, whatever other library brings some", "[apps]")
{
  cholmod_common common;
  cholmod_start(&common); // CHOLMOD is loaded, with the library that it was linked to
  cholmod_finish(&common);
  void *const atlas            = dlopen("libf77blas.so.3", RTLD_LAZY | RTLD_NOLOAD);
  const auto [kernel, library] = GENERATE(table<const char *, const char *>({{"dgemm_", "libblas.so.3"},
                                                                             {"dsyrk_", "libblas.so.3"},
                                                                             {"dtrsm_", "libblas.so.3"},
                                                                             {"dgemv_", "libblas.so.3"},
                                                                             {"dtrsv_", "libblas.so.3"},
                                                                             {"dpotrf_", "liblapack.so.3"}}));
  INFO(kernel);
  void *const system = dlopen(library, RTLD_LAZY | RTLD_NOLOAD);
  REQUIRE(system);
  void *const used = dlsym(RTLD_DEFAULT, kernel);
  REQUIRE(used);
  CHECK(used == dlsym(system, kernel));
  if (atlas)
    CHECK(used != dlsym(atlas, kernel));
  // Where OpenBLAS is installed, the system's libblas is a few names for it, from the same folder.
  if (void *const openblas = dlopen("libopenblas.so.0", RTLD_LAZY))
    CHECK(folder_of(used) == folder_of(dlsym(openblas, "openblas_get_config")));
}
