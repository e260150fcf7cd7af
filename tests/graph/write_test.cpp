#include "graph/file/write.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "tests/graph/toy_graphs.h"

namespace kinegraph {
namespace {

namespace fs = std::filesystem;

class Canonical : public testing::Test {
 protected:
  // Text -> document -> text.
  std::string again(std::string_view text) {
    ReadResult result = read_document(text, "g.kg.json", registry_, migrate_);
    EXPECT_FALSE(has_error(result.problems)) << toys::all_text(result.problems);
    return write_document(result.document, registry_);
  }
  void keeps(const std::string& text) { EXPECT_EQ(again(text), text); }

  Registry registry_ = toys::registry();
  bool migrate_ = true;
};

TEST_F(Canonical, TheContractsExampleComesBackByteForByte) {
  keeps(toys::example);
}

TEST_F(Canonical, AnEmptyGraphIsFormatAndSchema) {
  const std::string empty = "{\n  \"format\": \"kinegraph\",\n  \"schema\": 1\n}\n";
  keeps(empty);
  EXPECT_EQ(
      again(
          R"({"schema":1,"ui":{"nodes":{}},"publish":{"params":{}},"variables":{},"nodes":{},"format":"kinegraph"})"),
      empty);
}

TEST_F(Canonical, EverythingAFileCanHoldComesBackByteForByte) {
  keeps(R"({
  "format": "kinegraph",
  "schema": 1,
  "variables": {
    "clip": "walk",
    "deep": {
      "a": {},
      "list": [1, [2, 3], null]
    },
    "rate": 0.25
  },
  "nodes": {
    "all": {
      "type": "Concatenate",
      "enabled": false,
      "note": "two \"walks\"\nin a row é",
      "inputs": {
        "motions": [
          "walk.motion",
          "walk.motion"
        ]
      },
      "x-studio": {
        "empty": {},
        "shots": [
          {"a": 1.50, "b": []},
          {}
        ]
      }
    },
    "future": {
      "type": "Future",
      "version": 7,
      "enabled": true,
      "note": "",
      "params": {
        "a": 1.500,
        "b": [1e2, -0.0, {"a": 2, "z": 1}],
        "empty": {}
      },
      "inputs": {
        "many": [
          "walk.motion",
          "all.motion"
        ],
        "one": "walk.motion"
      },
      "weird": 12345678901234567890.10
    },
    "t": {
      "type": "StyleTransfer",
      "params": {
        "amount": "${rate}",
        "edits": [
          {"component": 1, "factor": 0, "op": "scale"},
          {"component": 2, "keys": [[0, 0.5], [10, 1]], "op": "add"}
        ],
        "joints": "*Leg*, -Head",
        "seed": 9007199254740991,
        "weights": {
          "*Leg*": 2,
          "Head": 0.1
        }
      }
    },
    "walk": {
      "type": "Load",
      "params": {
        "file": "clips/${clip}.bvh",
        "range": [10, null],
        "unit": 0.0254
      },
      "x-take": 3.0
    }
  },
  "publish": {
    "inputs": {
      "motion": "t.motion"
    },
    "outputs": {
      "result": "all.motion"
    },
    "params": {
      "amounts": [
        "t.amount",
        "t.amount"
      ]
    },
    "x-kept": null
  },
  "ui": {
    "frames": {
      "f": {
        "color": "#ff0000",
        "nodes": ["all", "walk"],
        "title": "F"
      }
    },
    "nodes": {
      "walk": {
        "color": "#00ff00",
        "pos": [-20, 140],
        "x-mark": 1.0
      }
    },
    "notes": {
      "n": {
        "pos": [0, 0],
        "size": [100, 50],
        "text": "hello"
      }
    },
    "x-theme": "dark"
  },
  "x-a": 1E3,
  "x-b": [
    {"k": 0.10}
  ]
}
)");
}

TEST_F(Canonical, OrdersKeysAndLeavesOutWhatIsDefault) {
  EXPECT_EQ(
      again(
          R"({"nodes": {"b": {"inputs": {"motion": "a.motion"}, "x-z": 1, "note": "", "params": {"amount": 1.0,
      "root": "both", "joints": "Head", "edits": [], "weights": {}}, "enabled": true, "version": 1, "type": "StyleTransfer"},
      "a": {"type": "Load", "params": {"range": [0, null], "fps": 1.2e2}, "inputs": {}}},
      "schema": 1, "format": "kinegraph"})"),
      R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "a": {
      "type": "Load",
      "params": {
        "fps": 120
      }
    },
    "b": {
      "type": "StyleTransfer",
      "params": {
        "joints": "Head"
      },
      "inputs": {
        "motion": "a.motion"
      },
      "x-z": 1
    }
  }
}
)");
}

TEST_F(Canonical, NumbersAreShortestAndMinusZeroIsZero) {
  const std::string text = again(toys::with_nodes(
      R"("t": {"type": "StyleTransfer", "params": {"weights": {"a": -0.0, "b": 0.10, "c": 1E0, "d": 0.30000000000000004}}})"));
  EXPECT_NE(text.find("\"a\": 0,\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\"b\": 0.1,\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\"c\": 1,\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\"d\": 0.30000000000000004\n"), std::string::npos) << text;
}

TEST_F(Canonical, IsReachedInOneStep) {
  const std::string once = again(toys::with_nodes(
      R"("t": {"type": "Future", "zebra": 1.0, "params": {"b": 1e0}, "inputs": {"in": ["a.b"]}, "type2": []})",
      R"(, "ui": {"nodes": {"t": {"pos": [1, 2]}, "u": {}}})"));
  EXPECT_EQ(again(once), once);
}

TEST_F(Canonical, AnOldNodeIsLeftAsItStandsWhenNotMigrated) {
  migrate_ = false;
  keeps(R"({
  "format": "kinegraph",
  "schema": 1,
  "nodes": {
    "a": {
      "type": "Aged",
      "params": {
        "speed": 150.0
      },
      "inputs": {
        "in": "b.motion"
      }
    },
    "b": {
      "type": "Load"
    }
  }
}
)");
}

TEST_F(Canonical, ANewerFileIsWrittenAsItWas) {
  const std::string text = R"({"format": "kinegraph", "schema": 2, "wires": [1.0]})";
  ReadResult result = read_document(text, "g", registry_);
  EXPECT_TRUE(result.document.read_only);
  EXPECT_EQ(write_document(result.document, registry_), text);
}

class WriteFileAtomically : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("kinegraph_write_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }
  static std::string content(const fs::path& path) {
    std::ifstream in(path);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

TEST_F(WriteFileAtomically, MakesAndReplaces) {
  const fs::path path = folder_ / "a.kg.json";
  write_file_atomically(path.string(), "one");
  write_file_atomically(path.string(), "two");
  EXPECT_EQ(content(path), "two");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(WriteFileAtomically, KeepsPermissionsAndLinks) {
  const fs::path path = folder_ / "a.kg.json", link = folder_ / "link.kg.json";
  write_file_atomically(path.string(), "one");
  fs::permissions(path, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  fs::create_symlink("a.kg.json", link);
  write_file_atomically(link.string(), "two");
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(content(path), "two");
  EXPECT_EQ(fs::status(path).permissions(),
            fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
}

TEST_F(WriteFileAtomically, SaysWhatItCouldNotWriteAndLeavesNothingBehind) {
  const fs::path path = folder_ / "missing" / "a.kg.json";
  try {
    write_file_atomically(path.string(), "one");
    FAIL() << "wrote into a folder that isn't there";
  } catch (const Failure& failure) {
    EXPECT_EQ(failure.diagnostic().code, "cannot-write");
    EXPECT_EQ(failure.diagnostic().file, path.string());
    EXPECT_NE(failure.diagnostic().message.find(path.parent_path().string()), std::string::npos);
  }
  fs::create_directory(folder_ / "taken");
  EXPECT_THROW(write_file_atomically((folder_ / "taken").string(), "x"), Failure);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace kinegraph
