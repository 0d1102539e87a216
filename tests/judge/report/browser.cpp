#include "judge/report/browser.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

#include "paths.h"

namespace limpid::test {
namespace {

namespace fs = std::filesystem;

std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen(command.c_str(), "r");
  std::array<char, 4096> part;
  for (std::size_t n; pipe && (n = std::fread(part.data(), 1, part.size(), pipe)) > 0;) {
    text.append(part.data(), n);
  }
  return pipe && ::pclose(pipe) == 0 ? text : "";
}

}  // namespace

nlohmann::json asked(std::string page, const std::string& expression) {
  const std::string browser = CHROMIUM;
  if (!fs::exists(browser)) {
    ADD_FAILURE() << "no browser: install chromium (tools/dev setup) and configure anew";
    return {};
  }
  const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = fs::path(testing::TempDir()) / ("limpid_page_" + name);
  fs::create_directories(folder);
  page.insert(page.find("<title>"),
              "<script>const complaints = [];\n"
              "window.addEventListener('error', (e) => complaints.push(e.message));</script>\n");
  const std::string begin = "<script type=\"application/json\" id=\"answer\">";
  page.insert(page.rfind("</body>"),
              begin +
                  "</script>\n<script>document.getElementById('answer').textContent = "
                  "JSON.stringify({complaints, answer: (" +
                  expression + ")}).replaceAll('<', '\\\\u003c');</script>\n");
  std::ofstream(folder / "page.html", std::ios::binary) << page;
  const std::string dom =
      output_of("'" + browser + "' --headless --no-sandbox --disable-gpu --disable-dev-shm-usage" +
                " --user-data-dir='" + (folder / "profile").string() + "' --dump-dom 'file://" +
                (folder / "page.html").string() + "' 2>" + (folder / "log").string());
  const std::size_t at = dom.find(begin);
  const std::size_t from = at + begin.size(), to = dom.find("</script>", from);
  if (at == dom.npos || to == from) {
    ADD_FAILURE() << "the page did not answer to " << expression << "\n"
                  << std::ifstream(folder / "log").rdbuf();
    return {};
  }
  const nlohmann::json seen = nlohmann::json::parse(dom.substr(from, to - from));
  EXPECT_TRUE(seen["complaints"].empty()) << seen["complaints"];
  fs::remove_all(folder);
  return seen["answer"];
}

}  // namespace limpid::test
