#include "catena/core/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

#include "catena/core/error.h"
#include "catena/properties/testing/device_file.h"

namespace catena {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// In a folder of its own, the devices too: a wrong OutputFile replaces what a link leads to.
class OutputFiles : public testing::Test {
 protected:
  OutputFiles() : folder_(fs::temp_directory_path() / ("catena-output-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~OutputFiles() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder_)) all.insert(entry.path().filename().string());
    return all;
  }
  /// What is said when nothing can be written there.
  static std::string refusal(const fs::path& name, const std::string& text = "x") {
    try {
      write_file(name, text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

 private:
  fs::path folder_;
};

TEST_F(OutputFiles, HaveTheirNameOnlyWhenComplete) {
  write_file(file("a"), "old");
  {
    OutputFile half(file("a"));
    half.write("new");
    EXPECT_EQ(text_of(file("a")), "old");
  }
  EXPECT_EQ(text_of(file("a")), "old");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
  write_file(file("a"), "new");
  EXPECT_EQ(text_of(file("a")), "new");
  EXPECT_EQ(names(), std::set<std::string>{"a"});
}

/// Whatever ends the process, and however much was written.
TEST_F(OutputFiles, LeaveNothingBehindWhenTheProcessIsKilled) {
  const int nameless = open(file("").c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (nameless < 0) GTEST_SKIP() << "this file system has no nameless files";
  close(nameless);
  write_file(file("a"), "old");
  for (const int signal : {SIGINT, SIGTERM, SIGKILL, SIGSEGV}) {
    const pid_t child = fork();
    if (child == 0) {
      const rlimit no_core{0, 0};
      setrlimit(RLIMIT_CORE, &no_core);
      std::signal(signal, SIG_DFL);  // a sanitizer has its own
      OutputFile half(file("a"));
      half.write(std::string(1'000'000, 'x'));
      raise(signal);
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status)) << signal;
    EXPECT_EQ(names(), std::set<std::string>{"a"}) << signal;
    EXPECT_EQ(text_of(file("a")), "old") << signal;
  }
}

/// A sandbox forbids links.
void forbid_links() {
  sock_filter steps[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_linkat, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  const sock_fprog program{std::size(steps), steps};
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
      prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) != 0)
    std::_Exit(77);
}

/// A container or a chroot has no /proc.
void lose_proc() {
  if (unshare(CLONE_NEWNS) != 0 || mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("none", "/proc", "tmpfs", 0, nullptr) != 0)
    std::_Exit(77);
}

TEST_F(OutputFiles, AreWrittenWhereLinksAreForbiddenOrThereIsNoProc) {
  for (const auto& lose : {forbid_links, lose_proc}) {
    const std::string text(3 << 20, 'x');
    write_file(file("old"), "old");
    chmod(file("old").c_str(), 0640);
    const pid_t child = fork();
    if (child == 0) {
      lose();
      for (const char* const name : {"old", "new"})
        if (const std::string why = refusal(file(name), text); !why.empty()) {
          std::fprintf(stderr, "%s\n", why.c_str());
          std::_Exit(1);
        }
      std::_Exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFEXITED(status));
    if (WEXITSTATUS(status) == 77) continue;  // that is for root alone, or for nobody here
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(names(), (std::set<std::string>{"new", "old"}));
    for (const char* const name : {"old", "new"}) EXPECT_TRUE(text_of(file(name)) == text) << name;
    EXPECT_EQ(fs::status(file("old")).permissions(), fs::perms(0640));
    fs::remove(file("new"));
  }
}

TEST_F(OutputFiles, TwoOfOneNameDoNotMix) {
  OutputFile first(file("a")), second(file("a"));
  first.write("first");
  second.write("second");
  first.close();
  EXPECT_EQ(text_of(file("a")), "first");
  second.close();
  EXPECT_EQ(text_of(file("a")), "second");
}

TEST_F(OutputFiles, ALinkStaysAndItsTargetIsReplaced) {
  fs::create_directory(file("below"));
  write_file(file("below/a"), "old, and longer than the new");
  fs::create_symlink("below/a", file("link"));
  fs::create_symlink(file("link"), file("link to link"));
  fs::create_symlink("new", file("link to nothing"));
  write_file(file("link to link"), "one");
  EXPECT_EQ(text_of(file("below/a")), "one");
  EXPECT_FALSE(fs::is_symlink(file("below/a")));
  write_file(file("link to nothing"), "two");
  EXPECT_EQ(text_of(file("new")), "two");
  for (const char* link : {"link", "link to link", "link to nothing"})
    EXPECT_TRUE(fs::is_symlink(file(link))) << link;
  EXPECT_EQ(names(), (std::set<std::string>{"below", "link", "link to link", "link to nothing", "new"}));
}

/// The name that it has meanwhile is no longer.
TEST_F(OutputFiles, MayHaveTheLongestNameThatThereIs) {
  for (const std::size_t size : {200u, 201u, 255u}) {
    const std::string name(size, 'n');
    write_file(file(name), "x");
    EXPECT_EQ(text_of(file(name)), "x");
    EXPECT_EQ(names(), std::set<std::string>{name});
    fs::remove(file(name));
  }
  EXPECT_THROW(OutputFile(file(std::string(256, 'n'))), InputError) << "from the start";
}

/// A number is the name of a descriptor in one folder alone.
TEST_F(OutputFiles, ANumberIsANameLikeAnyOther) {
  const int open_already = open(file("other").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  const std::string number = std::to_string(open_already);
  write_file(file(number), "a file");
  close(open_already);
  EXPECT_EQ(text_of(file(number)), "a file");
  EXPECT_EQ(text_of(file("other")), "");
}

TEST_F(OutputFiles, MayBeReadByWhomTheUserLets) {
  const mode_t before = umask(0026);
  write_file(file("a"), "x");
  umask(before);
  EXPECT_EQ(fs::status(file("a")).permissions(), static_cast<fs::perms>(0640));
  for (const auto kept : {0600, 0644, 0664, 0400, 0755}) {
    fs::permissions(file("a"), static_cast<fs::perms>(kept));
    write_file(file("a"), "y");
    EXPECT_EQ(fs::status(file("a")).permissions(), static_cast<fs::perms>(kept));
  }
}

/// A program that is started meanwhile holds none of them open.
TEST_F(OutputFiles, AreNotInherited) {
  const int through = open(file("through").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(mkfifo(file("fifo").c_str(), 0600), 0);
  const int reader = open(file("fifo").c_str(), O_RDWR | O_CLOEXEC);
  const auto inherited = [] {
    std::set<int> open_still;
    for (int k = 3; k < 1024; ++k)
      if (const int flags = fcntl(k, F_GETFD); flags >= 0 && !(flags & FD_CLOEXEC)) open_still.insert(k);
    return open_still;
  };
  const std::set<int> before = inherited();
  const OutputFile one(file("a")), other("/dev/fd/" + std::to_string(through)), third(file("fifo"));
  EXPECT_EQ(inherited(), before);
  close(through), close(reader);
}

/// What cannot get its name leaves nothing, and what a killed process of our number left is not in the way.
TEST_F(OutputFiles, LeaveNothingBesideWhatTheyCannotReplace) {
  std::string left;
  {
    OutputFile late(file("a"));
    fs::create_directory(file("a"));
    EXPECT_THROW(late.close(), InputError);
    for (const std::string& name : names())
      if (name != "a") left = name;
  }
  EXPECT_EQ(names(), std::set<std::string>{"a"});
  const std::size_t dash = left.rfind('-') + 1;  // a.PROCESS-NUMBER.unfinished
  ASSERT_TRUE(left.ends_with(".unfinished")) << left;
  const std::string next = "b" + left.substr(1, dash - 1) + std::to_string(std::stoi(left.substr(dash)) + 1);
  std::ofstream(file(next + ".unfinished")) << "half of it";
  write_file(file("b"), "all");
  EXPECT_EQ(text_of(file("b")), "all");
  EXPECT_EQ(names(), (std::set<std::string>{"a", "b"}));
}

TEST_F(OutputFiles, AFifoIsWrittenThrough) {
  ASSERT_EQ(mkfifo(file("fifo").c_str(), 0600), 0);
  const int keep_open = open(file("fifo").c_str(), O_RDWR | O_CLOEXEC);  // nobody waits, whatever goes wrong
  write_file(file("fifo"), "through");
  char text[7] = {};
  ASSERT_TRUE(fs::is_fifo(file("fifo")));
  EXPECT_EQ(read(keep_open, text, sizeof text), 7);
  EXPECT_EQ(std::string(text, sizeof text), "through");
  close(keep_open);
}

TEST_F(OutputFiles, ADeviceIsWrittenThrough) {
  const auto full_device = properties::DeviceFile::full(file("full device")),
             null_device = properties::DeviceFile::null(file("null device"));
  if (!full_device || !null_device) GTEST_SKIP() << "no device can be made here, and /dev can be written";
  const std::set<std::string> before = names();
  fs::create_symlink(*full_device, file("full"));
  fs::create_symlink(*null_device, file("null"));
  EXPECT_EQ(refusal(file("full")), "cannot write " + file("full").string() + ": No space left on device");
  EXPECT_EQ(refusal(file("full"), std::string(100'000, 'x')),
            "cannot write " + file("full").string() + ": No space left on device");
  write_file(file("null"), "nothing");
  EXPECT_EQ(fs::read_symlink(file("full")), *full_device);
  EXPECT_EQ(fs::read_symlink(file("null")), *null_device);
  EXPECT_TRUE(fs::is_character_file(*null_device));
  std::set<std::string> after = names();
  EXPECT_EQ(after.erase("full") + after.erase("null"), 2u);
  EXPECT_EQ(after, before);
}

TEST_F(OutputFiles, AnOpenDescriptorIsWrittenWhereItStands) {
  const int open_already = open(file("a").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  ASSERT_EQ(write(open_already, "before ", 7), 7);
  const std::string number = std::to_string(open_already);
  write_file("/dev/fd/" + number, "one ");
  write_file("/proc/self/fd/" + number, "two ");
  fs::create_symlink("/dev/fd/" + number, file("link"));
  write_file(file("link"), "three ");
  ASSERT_EQ(write(open_already, "after", 5), 5);
  close(open_already);
  EXPECT_EQ(text_of(file("a")), "before one two three after");
  EXPECT_TRUE(fs::is_symlink(file("link")));
}

TEST_F(OutputFiles, SayWhatIsWrong) {
  EXPECT_EQ(refusal("/nowhere/a"), "cannot write /nowhere/a: No such file or directory");
  EXPECT_EQ(refusal(file("")), "cannot write " + file("").string() + ": Is a directory");
  fs::create_symlink("round", file("round"));
  EXPECT_EQ(refusal(file("round")),
            "cannot write " + file("round").string() + ": Too many levels of symbolic links");
  EXPECT_EQ(refusal("/dev/fd/999"), "cannot write /dev/fd/999: Bad file descriptor");
}

/// And not taken for 1, which is so many times 2^32 less.
TEST_F(OutputFiles, RefuseADescriptorThatNoneCanBe) {
  testing::internal::CaptureStdout();
  for (const char* name :
       {"/dev/fd/4294967297", "/dev/fd/18446744073709551617", "/dev/fd/+1", "/dev/fd/2147483648"})
    EXPECT_TRUE(refusal(name).starts_with(std::string("cannot write ") + name))
        << name << ": " << refusal(name);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace catena
