#include "graph/evaluate/caught.h"

#include <new>
#include <stdexcept>
#include <string>

namespace kinegraph {

Diagnostic caught() {
  const char* report_it = "this is a fault of the program: please report it with the graph";
  try {
    throw;
  } catch (const Failure& failure) {
    return failure.diagnostic();
  } catch (const std::bad_alloc&) {
    return error("out-of-memory", "the machine gave no more memory")
        .hinting("close other programs, or shorten the motions");
  } catch (const std::length_error& what) {
    return error("out-of-memory", std::string("something grew past any size: ") + what.what())
        .hinting("shorten the motions");
  } catch (const std::exception& what) {
    return error("internal", what.what()).hinting(report_it);
  } catch (...) {
    return error("internal", "something unknown was thrown").hinting(report_it);
  }
}

}  // namespace kinegraph
