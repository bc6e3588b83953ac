//! A table as a file has it: every cell with its quotes, every line with its end. A cell that is not set comes out byte for byte.

use std::borrow::Cow;

use super::ReleaseError;
use super::encoding::Encoding;
use crate::student::folded;

/// A table in a file.
#[derive(Debug, Clone)]
pub(super) struct Sheet {
    name: String,
    encoding: Encoding,
    delimiter: char,
    rows: Vec<SheetRow>,
    /// The row of the header.
    header: usize,
}

/// A row, as it stands in the file.
#[derive(Debug, Clone)]
struct SheetRow {
    /// Its first line, from one.
    line: usize,
    /// Its cells with their quotes.
    cells: Vec<String>,
    /// What ends it.
    end: &'static str,
}

impl Sheet {
    /// Reads a table. The first row that is not empty is its header.
    ///
    /// # Errors
    /// A spreadsheet, a quote that is not closed, half a character, or nothing at all.
    pub(super) fn read(name: &str, bytes: &[u8]) -> Result<Self, ReleaseError> {
        let not_csv = |why: String| ReleaseError::NotCsv {
            name: name.to_owned(),
            why,
        };
        if bytes.starts_with(b"PK\x03\x04") || bytes.starts_with(&[0xd0, 0xcf, 0x11, 0xe0]) {
            return Err(not_csv("it is a spreadsheet or an archive".to_owned()));
        }
        let (text, encoding) = Encoding::read(bytes)
            .ok_or_else(|| not_csv("it ends or breaks off inside a character".to_owned()))?;
        if text.contains('\0') {
            return Err(not_csv("it holds bytes that are no text".to_owned()));
        }
        let delimiter = delimiter(&text);
        let rows = rows(&text, delimiter)
            .map_err(|line| not_csv(format!("the quote of line {line} is not closed")))?;
        let is_blank =
            |row: &&SheetRow| row.cells.iter().all(|raw| unquoted(raw).trim().is_empty());
        let header = rows.iter().position(|row| !is_blank(&row));
        Ok(Self {
            name: name.to_owned(),
            encoding,
            delimiter,
            header: header.ok_or_else(|| not_csv("it is empty".to_owned()))?,
            rows,
        })
    }

    /// The name of the file.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// What stands between cells.
    pub(super) fn delimiter(&self) -> char {
        self.delimiter
    }

    /// The encoding.
    pub(super) fn encoding(&self) -> Encoding {
        self.encoding
    }

    /// The headers.
    pub(super) fn headers(&self) -> Vec<String> {
        let cells = self.rows[self.header].cells.iter();
        cells.map(|raw| unquoted(raw).trim().to_owned()).collect()
    }

    /// The columns whose header is one of `names`, in any case.
    pub(super) fn columns(&self, names: &[&str]) -> Vec<usize> {
        let names: Vec<String> = names.iter().map(|name| folded(name)).collect();
        let headers = self.headers().into_iter().enumerate();
        headers
            .filter(|(_, header)| names.contains(&folded(header)))
            .map(|(at, _)| at)
            .collect()
    }

    /// The one column whose header is one of `names`; none where there is none.
    ///
    /// # Errors
    /// Several such columns.
    pub(super) fn column(
        &self,
        wanted: &str,
        names: &[&str],
    ) -> Result<Option<usize>, ReleaseError> {
        match self.columns(names)[..] {
            [] => Ok(None),
            [one] => Ok(Some(one)),
            ref several => {
                let headers = self.headers();
                Err(ReleaseError::SeveralColumns {
                    name: self.name.clone(),
                    wanted: wanted.to_owned(),
                    found: several.iter().map(|at| headers[*at].clone()).collect(),
                })
            }
        }
    }

    /// That there is no column for `wanted`.
    pub(super) fn no_column(&self, wanted: &str, help: &str) -> ReleaseError {
        ReleaseError::NoColumn {
            name: self.name.clone(),
            wanted: wanted.to_owned(),
            found: self.headers(),
            help: help.to_owned(),
        }
    }

    /// The rows below the header that are not empty.
    pub(super) fn below_header(&self) -> impl Iterator<Item = usize> + use<'_> {
        let rows = self.header + 1..self.rows.len();
        rows.filter(|row| !self.is_blank(*row))
    }

    fn is_blank(&self, row: usize) -> bool {
        let mut cells = self.rows[row].cells.iter();
        cells.all(|raw| unquoted(raw).trim().is_empty())
    }

    /// Refuses rows that have more cells than the header: a comma without quotes moved them, and points would land in another column.
    ///
    /// # Errors
    /// The first such row.
    pub(super) fn check_widths(&self) -> Result<(), ReleaseError> {
        let expected = self.rows[self.header].cells.len();
        for row in &self.rows[self.header..] {
            let beyond = row.cells.get(expected..).unwrap_or_default();
            if beyond.iter().any(|raw| !unquoted(raw).trim().is_empty()) {
                return Err(ReleaseError::RowWidth {
                    name: self.name.clone(),
                    line: row.line,
                    cells: row.cells.len(),
                    expected,
                });
            }
        }
        Ok(())
    }

    /// The line of a row, from one.
    pub(super) fn line(&self, row: usize) -> usize {
        self.rows[row].line
    }

    /// What a cell says; nothing where the row is too short.
    pub(super) fn value(&self, row: usize, column: usize) -> Cow<'_, str> {
        let raw = self.rows[row].cells.get(column);
        raw.map_or(Cow::Borrowed(""), |raw| unquoted(raw))
    }

    /// Sets a cell. One that says so already is left as it is; a row that is too short is filled up.
    pub(super) fn set(&mut self, row: usize, column: usize, value: &str) {
        if self.value(row, column) == value {
            return;
        }
        let delimiter = self.delimiter;
        let cells = &mut self.rows[row].cells;
        if cells.len() <= column {
            cells.resize(column + 1, String::new());
        }
        cells[column] = quoted(value, delimiter, cells[column].starts_with('"'));
    }

    /// The file.
    pub(super) fn bytes(&self) -> Vec<u8> {
        let mut text = String::new();
        let delimiter = self.delimiter.to_string();
        for row in &self.rows {
            text += &row.cells.join(&delimiter);
            text += row.end;
        }
        self.encoding.bytes(&text)
    }
}

/// A cell with quotes, where it needs them or had them.
fn quoted(value: &str, delimiter: char, had_quotes: bool) -> String {
    let needs = |c: char| c == delimiter || matches!(c, '"' | '\r' | '\n');
    let is_padded = value.starts_with(' ') || value.ends_with(' ');
    if had_quotes || is_padded || value.contains(needs) {
        format!("\"{}\"", value.replace('"', "\"\""))
    } else {
        value.to_owned()
    }
}

/// What a cell says.
fn unquoted(raw: &str) -> Cow<'_, str> {
    let Some(inside) = raw.strip_prefix('"') else {
        return Cow::Borrowed(raw);
    };
    let mut value = String::new();
    let mut is_open = true;
    let mut chars = inside.chars().peekable();
    while let Some(c) = chars.next() {
        match c {
            '"' if is_open && chars.peek() == Some(&'"') => {
                chars.next();
                value.push('"');
            }
            '"' if is_open => is_open = false,
            c => value.push(c),
        }
    }
    Cow::Owned(value)
}

/// What stands between cells: whichever the first line has most of outside quotes.
fn delimiter(text: &str) -> char {
    let mut counts = [(',', 0), (';', 0), ('\t', 0)];
    let mut is_quoted = false;
    for c in text.trim_start_matches(['\r', '\n']).chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            '\r' | '\n' if !is_quoted => break,
            c if !is_quoted => {
                for (sign, count) in &mut counts {
                    *count += usize::from(*sign == c);
                }
            }
            _ => {}
        }
    }
    // the first of equal ones
    let most = counts.iter().rev().max_by_key(|(_, count)| *count);
    most.map_or(',', |(sign, _)| *sign)
}

/// The rows of a text.
///
/// # Errors
/// The line of a quote that is not closed.
fn rows(text: &str, delimiter: char) -> Result<Vec<SheetRow>, usize> {
    let mut rows = Vec::new();
    let mut cells = vec![String::new()];
    let (mut line, mut first_line, mut quote_line) = (1, 1, 1);
    let mut is_quoted = false;
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        let is_last_of_line = c == '\n' || (c == '\r' && chars.peek() != Some(&'\n'));
        line += usize::from(is_last_of_line);
        let cell = cells.last_mut().expect("a row has a cell at least");
        match c {
            '"' if is_quoted => {
                cell.push(c);
                // two quotes are one in the text
                match chars.next_if_eq(&'"') {
                    Some(second) => cell.push(second),
                    None => is_quoted = false,
                }
            }
            '"' if cell.is_empty() => {
                (is_quoted, quote_line) = (true, line);
                cell.push(c);
            }
            c if is_quoted => cell.push(c),
            c if c == delimiter => cells.push(String::new()),
            '\r' | '\n' => {
                let end = match c {
                    '\n' => "\n",
                    _ if chars.next_if_eq(&'\n').is_some() => {
                        line += 1;
                        "\r\n"
                    }
                    _ => "\r",
                };
                rows.push(SheetRow {
                    line: first_line,
                    cells: std::mem::replace(&mut cells, vec![String::new()]),
                    end,
                });
                first_line = line;
            }
            c => cell.push(c),
        }
    }
    if is_quoted {
        return Err(quote_line);
    }
    if cells.len() > 1 || !cells[0].is_empty() {
        rows.push(SheetRow {
            line: first_line,
            cells,
            end: "",
        });
    }
    Ok(rows)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sheet(text: &str) -> Sheet {
        Sheet::read("g.csv", text.as_bytes()).unwrap()
    }

    #[test]
    fn a_sheet_comes_out_as_it_came_in() {
        for text in [
            "a,b\n1,2\n",
            "a;\"b;c\"\r\n\"x\ny\";\"q\"\"q\"\r\n\r\n ;\r\nlast;",
            "\n\na\tb\r1\t\"2\"x\r",
            "a",
            "\u{feff}a,b\n1,2,,\n",
        ] {
            assert_eq!(sheet(text).bytes(), text.as_bytes(), "{text:?}");
        }
    }

    #[test]
    fn one_cell_is_changed_and_nothing_else() {
        let mut sheet = sheet("a;b;c\r\n\"1\";x,y;\"z\"\r\n\r\n2\r\n");
        sheet.set(1, 1, "4,5");
        sheet.set(1, 2, "say \"hi\"");
        sheet.set(3, 2, "p;q");
        // says so already
        sheet.set(1, 0, "1");
        let text = String::from_utf8(sheet.bytes()).unwrap();
        assert_eq!(
            text,
            "a;b;c\r\n\"1\";4,5;\"say \"\"hi\"\"\"\r\n\r\n2;;\"p;q\"\r\n"
        );
    }

    #[test]
    fn lines_are_counted_through_quotes() {
        let sheet = sheet("a,b\r\n\"x\r\ny\",1\r\n\"u\nv\",2\nlast,3");
        let rows: Vec<usize> = sheet.below_header().collect();
        let lines: Vec<usize> = rows.iter().map(|row| sheet.line(*row)).collect();
        assert_eq!(lines, [2, 4, 6]);
        assert_eq!(sheet.value(1, 0), "x\r\ny");
    }

    #[test]
    fn what_stands_between_cells_is_found_outside_quotes() {
        assert_eq!(delimiter("\"a;b;c;d\",b\n"), ',');
        assert_eq!(delimiter("a;b;\"x,y,z,w\"\n"), ';');
        assert_eq!(delimiter("a\tb\n1,2,3"), '\t');
        assert_eq!(delimiter("a"), ',');
    }

    #[test]
    fn what_is_no_table_is_refused() {
        for (bytes, part) in [
            (&b"PK\x03\x04x"[..], "a spreadsheet"),
            (b"a,b\n1,\"2\n", "the quote of line 2 is not closed"),
            (b"\n , \n", "it is empty"),
            (b"\xff\xfea", "inside a character"),
            (b"a\0b", "no text"),
        ] {
            let error = Sheet::read("g.csv", bytes).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
        let error = sheet("a,b\nx,y,z\n").check_widths().unwrap_err();
        assert!(
            error
                .to_string()
                .contains("line 2: 3 cells, and the header has 2")
        );
        assert!(sheet("a,b\nx,y,,\nz\n").check_widths().is_ok());
    }
}
