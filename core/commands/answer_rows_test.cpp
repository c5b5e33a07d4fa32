#include "catena/core/commands/answer_rows.h"

#include <gtest/gtest.h>

#include "catena/core/commands/row_file.h"
#include "catena/core/error.h"

namespace catena {
namespace {

/// A name says what is in the file, or is refused.
TEST(AnswerTables, AreWhatTheirNamesSay) {
  for (const char* name : {"p.csv.gz", "p.jsonl.gz", "p.CSV.GZ"}) {
    AnswerTables pairs, counts;
    pairs.pairs = counts.counts = name;
    EXPECT_THROW(check_answer_options({}, pairs), InputError) << name;
    EXPECT_THROW(check_answer_options({}, counts), InputError) << name;
  }
  for (const char* name : {"p.csv", "p.jsonl", "p.gz.csv", "p", ""}) {
    AnswerTables both;
    both.pairs = both.counts = name;
    EXPECT_NO_THROW(check_answer_options({}, both)) << name;
  }
  for (const char* json : {"p.jsonl", "p.JSONL", "a.csv.JsonL"}) EXPECT_EQ(RowText(json, {"x"}).heading(), "") << json;
  for (const char* csv : {"p.csv", "p.json", "jsonl", "p.jsonl.csv"}) EXPECT_EQ(RowText(csv, {"x"}).heading(), "x\n") << csv;
}

}  // namespace
}  // namespace catena
