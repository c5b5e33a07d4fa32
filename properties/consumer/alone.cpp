// Of a header that is compiled alone.
int main() {}
