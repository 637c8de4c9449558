#include "commands.h"
#include "program.h"

int main(int argument_count, char** arguments) {
  hedgerow::tool::Program program;
  hedgerow::tool::add_commands(program);
  return static_cast<int>(program.run(argument_count, arguments));
}
