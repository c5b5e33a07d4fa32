#include "catena/core/commands/row_file.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace catena {
namespace {

TEST(RowText, HasACellForEachColumn) {
  for (const std::string name : {"a.csv", "a.jsonl"}) {
    RowText row(name, {"x", "y"});
    row.number(1);
    EXPECT_THROW(row.end_row(), std::logic_error) << "one is lacking";
    row.text("a,b");
    EXPECT_THROW(row.real(0.5), std::logic_error) << "one too many";
    row.end_row();
    EXPECT_EQ(row.take(), name == "a.csv" ? "1,\"a,b\"\n" : "{\"x\":1,\"y\":\"a,b\"}\n");
    EXPECT_EQ(row.heading(), name == "a.csv" ? "x,y\n" : "");
  }
}

}  // namespace
}  // namespace catena
