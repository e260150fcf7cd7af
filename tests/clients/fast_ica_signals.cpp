// Writes, for scikit-learn to compare (fast_ica_agreement.py), whitened channels of two clips and the signals
// that FastICA finds in them from each of several starts (fast_ica.h):
//   fast_ica_signals FOLDER COMPONENTS STARTS CLIP CLIP
// z.bin, and of each start N startN.bin and NONLINEARITY_METHODN.bin: COMPONENTS rows of doubles as the machine
// has them. Prints the names of those that did not converge.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "graph/evaluate/file_store.h"
#include "nodes/components/channels.h"
#include "nodes/components/fast_ica.h"
#include "nodes/components/principal.h"
#include "nodes/files/motion_file.h"

namespace kinegraph {
namespace {

void write(const std::string& path, const Rows& rows) {
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(rows.data.data()),
            static_cast<std::streamsize>(rows.data.size() * sizeof(double)));
  if (!out) throw std::runtime_error("can't write " + path);
}

Rows channels_of_files(const std::vector<std::string>& paths) {
  Alone work;
  FileStore files;
  std::vector<std::shared_ptr<const Motion>> motions;
  for (const std::string& path : paths) {
    const MotionFile file = read_motion_file(path, {}, files, work);
    motions.push_back(std::make_shared<const Motion>(*file.motion()));
  }
  const std::vector<bool> all(static_cast<std::size_t>(motions.front()->joints()), true);
  const ChannelSpace space = space_of_motions(Representation::points, motions, all, true, {}, work);
  Rows out;
  for (const auto& motion : motions) {
    const Rows part = channels_of(space, *motion, {}, work);
    Rows longer(part.rows, out.columns + part.columns);
    for (std::size_t i = 0; i < part.rows; ++i) {
      if (out.columns) std::copy_n(out.row(i), out.columns, longer.row(i));
      std::copy_n(part.row(i), part.columns, longer.row(i) + out.columns);
    }
    out = std::move(longer);
  }
  return out;
}

void write_signals(const std::string& folder, std::size_t components, int starts,
                   const std::vector<std::string>& clips) {
  Alone work;
  const Rows x = channels_of_files(clips);
  const Rows z = whiten(x, principal_components(x, work), components, work).z;
  write(folder + "/z.bin", z);
  constexpr const char* names[] = {"logcosh", "pow3", "gauss"};
  for (int n = 0; n < starts; ++n) {
    const Rows start = starting_rotation(components, n, 0);
    write(folder + "/start" + std::to_string(n) + ".bin", start);
    for (int nonlinearity = 0; nonlinearity < 3; ++nonlinearity) {
      for (bool symmetric : {true, false}) {
        const FastIcaRun run =
            fast_ica(z, start, {static_cast<Nonlinearity>(nonlinearity), symmetric, 1e-8, 2000}, work);
        const std::string name =
            std::string(names[nonlinearity]) + (symmetric ? "_parallel" : "_deflation") + std::to_string(n);
        write(folder + "/" + name + ".bin", rotated(run.w, z));
        if (!run.converged) std::puts(name.c_str());
      }
    }
  }
}

}  // namespace
}  // namespace kinegraph

int main(int argc, char** argv) {
  if (argc != 6) {
    std::fputs("usage: fast_ica_signals FOLDER COMPONENTS STARTS CLIP CLIP\n", stderr);
    return 2;
  }
  try {
    kinegraph::write_signals(argv[1], static_cast<std::size_t>(std::atoi(argv[2])), std::atoi(argv[3]),
                             {argv[4], argv[5]});
  } catch (const kinegraph::Failure& failure) {
    std::fprintf(stderr, "%s\n", failure.diagnostic().message.c_str());
    return 1;
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    return 1;
  }
}
