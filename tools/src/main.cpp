#include <string>

#include <CLI/CLI.hpp>

int main(int argc, char** argv) {
  CLI::App app("Structure-of-arrays half-edge meshes", "hedgerow");
  app.set_version_flag("--version", std::string("hedgerow ") + HEDGEROW_VERSION);
  app.require_subcommand(1);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  return 0;
}
