// Tables that tests leave for the plots of docs/verification: only where ABUT_FORMS names a folder (tools/plot_forms.py does).
#pragma once

#include <cstdio>
#include <cstdlib>
#include <initializer_list>
#include <string>

namespace abut::scenes {

class Csv {
 public:
  Csv(const std::string& name, const char* header) {
    const char* folder = std::getenv("ABUT_FORMS");
    if (folder == nullptr) return;
    file_ = std::fopen((std::string(folder) + "/" + name + ".csv").c_str(), "w");
    if (file_ != nullptr) std::fprintf(file_, "%s\n", header);
  }
  Csv(const Csv&) = delete;
  Csv& operator=(const Csv&) = delete;
  ~Csv() {
    if (file_ != nullptr) std::fclose(file_);
  }

  void row(std::initializer_list<double> values) {
    if (file_ == nullptr) return;
    const char* comma = "";
    for (const double v : values) {
      std::fprintf(file_, "%s%.9g", comma, v);
      comma = ",";
    }
    std::fprintf(file_, "\n");
  }

 private:
  std::FILE* file_ = nullptr;
};

}  // namespace abut::scenes
