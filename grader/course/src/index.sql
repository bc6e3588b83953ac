-- The tables of course.sqlite; their version is `SCHEMA` in index.rs. docs/book.md describes every column.
CREATE TABLE meta (
    name TEXT PRIMARY KEY,
    value TEXT NOT NULL
) STRICT;
CREATE TABLE records (
    key TEXT PRIMARY KEY,
    lab TEXT NOT NULL,
    submission TEXT NOT NULL,
    engine TEXT NOT NULL,
    lab_version TEXT NOT NULL,
    staff_version TEXT,
    variant_of TEXT,
    verdict TEXT NOT NULL,
    points REAL NOT NULL,
    max_points REAL NOT NULL,
    is_under_resolved INTEGER NOT NULL
) STRICT;
CREATE INDEX records_of_lab ON records (lab);
CREATE TABLE tasks (
    record TEXT NOT NULL REFERENCES records (key),
    place INTEGER NOT NULL,
    name TEXT NOT NULL,
    title TEXT NOT NULL,
    verdict TEXT NOT NULL,
    points REAL NOT NULL,
    max_points REAL NOT NULL,
    operations INTEGER NOT NULL,
    digest TEXT NOT NULL,
    PRIMARY KEY (record, name)
) STRICT;
CREATE TABLE checks (
    record TEXT NOT NULL REFERENCES records (key),
    task TEXT NOT NULL,
    place INTEGER NOT NULL,
    name TEXT NOT NULL,
    title TEXT NOT NULL,
    outcome TEXT NOT NULL,
    points REAL NOT NULL,
    max_points REAL NOT NULL,
    quantity TEXT,
    value REAL,
    unit TEXT,
    full REAL,
    zero REAL,
    first_lost_s REAL,
    lost_in_hidden_only INTEGER NOT NULL,
    PRIMARY KEY (record, task, name)
) STRICT;
CREATE TABLE mistakes (
    record TEXT NOT NULL REFERENCES records (key),
    task TEXT NOT NULL,
    mistake TEXT NOT NULL,
    says TEXT NOT NULL,
    PRIMARY KEY (record, task, mistake)
) STRICT;
CREATE TABLE hand_ins (
    id TEXT PRIMARY KEY,
    student TEXT NOT NULL,
    lab TEXT NOT NULL,
    attempt INTEGER NOT NULL,
    submission TEXT NOT NULL,
    read_at TEXT NOT NULL,
    submitted_at TEXT,
    matched_by TEXT NOT NULL,
    failure TEXT
) STRICT;
CREATE INDEX hand_ins_of_student ON hand_ins (student, lab);
CREATE TABLE grades (
    hand_in TEXT NOT NULL REFERENCES hand_ins (id),
    record TEXT NOT NULL,
    at TEXT NOT NULL,
    by TEXT NOT NULL,
    why TEXT
) STRICT;
CREATE TABLE standings (
    student TEXT NOT NULL,
    lab TEXT NOT NULL,
    status TEXT NOT NULL,
    attempts INTEGER NOT NULL,
    attempt INTEGER,
    record TEXT,
    record_points REAL,
    points REAL,
    max_points REAL,
    late_s INTEGER,
    has_stale_fix INTEGER NOT NULL,
    is_without_sources INTEGER NOT NULL,
    is_under_resolved INTEGER NOT NULL,
    PRIMARY KEY (student, lab)
) STRICT;
