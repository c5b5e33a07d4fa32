#include "catena/core/readers/open_input.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "catena/core/error.h"

namespace catena {
namespace {

/// While one lives, standard input is this descriptor.
class StandardInput {
 public:
  explicit StandardInput(int descriptor) { dup2(descriptor, STDIN_FILENO); }
  ~StandardInput() { dup2(before_, STDIN_FILENO), close(before_); }

 private:
  int before_ = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
};

/// What is said against reading standard input; "" where it is read.
std::string refusal() {
  try {
    return OpenInput("-").read_all(), "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// Who writes it may be slower, and who started the program may have set it not to wait.
TEST(OpenInput, WaitsForWhatAPipeHasNotYet) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  ASSERT_EQ(fcntl(ends[0], F_SETFL, O_NONBLOCK), 0);
  const StandardInput standard(ends[0]);
  std::thread writer([&] {
    for (const std::string_view part : {"one ", "two ", "three"}) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      EXPECT_EQ(write(ends[1], part.data(), part.size()), static_cast<ssize_t>(part.size()));
    }
    close(ends[1]);
  });
  EXPECT_EQ(OpenInput("-").read_all(), "one two three");
  writer.join();
  close(ends[0]);
}

TEST(OpenInput, TakesNoErrorForTheEnd) {
  const int folder = open("/", O_RDONLY | O_CLOEXEC), sink = open("/dev/null", O_WRONLY | O_CLOEXEC);
  {
    const StandardInput standard(folder);
    EXPECT_EQ(refusal(), "standard input: cannot be read: Is a directory");
  }
  {
    const StandardInput standard(sink);
    EXPECT_EQ(refusal(), "standard input: cannot be read: it is closed, or open for writing alone");
  }
  close(folder), close(sink);
}

/// Of what somebody else has begun to read, the rest; of a file whose size is not told, all.
TEST(OpenInput, ReadsAllThatIsLeft) {
  const std::string name = testing::TempDir() + "open-input-" + std::to_string(getpid());
  const int file = open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  const std::string text = "of this the rest";
  ASSERT_EQ(write(file, text.data(), text.size()), static_cast<ssize_t>(text.size()));
  EXPECT_EQ(OpenInput(name).told_size(), text.size());
  EXPECT_EQ(OpenInput(name).read_all(), text);
  lseek(file, 8, SEEK_SET);
  {
    const StandardInput standard(file);
    EXPECT_EQ(OpenInput("-").told_size(), 8u);
    EXPECT_EQ(OpenInput("-").read_all(), "the rest");
  }
  close(file), unlink(name.c_str());
  EXPECT_FALSE(OpenInput("/proc/self/status").read_all().empty());
}

}  // namespace
}  // namespace catena
