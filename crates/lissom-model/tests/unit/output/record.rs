//! Tests of `output::record`, a module of it.

use super::super::CsvWriter;
use super::*;

#[test]
fn a_table_comes_back_from_its_text() {
    let columns = vec![
        Column::new("a.b", "x", "a.b", ""),
        Column::new("b", "", "b", ""),
        Column::new("q, \"r\"", "", "q, \"r\"", ""),
    ];
    let mut record = Record::default();
    let mut text = Vec::new();
    let mut writer = CsvWriter::new(&mut text);
    let both: [&mut dyn Writer; 2] = [&mut record, &mut writer];
    for writer in both {
        writer.begin(&columns).unwrap();
        for i in 0..5 {
            writer.row(f64::from(i) / 3.0, &[1e-9 / 7.0, f64::from(i), -0.1]).unwrap();
        }
        writer.finish().unwrap();
    }
    assert!(record.row(1.0, &[1.0]).is_err());
    let text = String::from_utf8(text).unwrap();
    assert_eq!(Record::from_csv(&text).unwrap(), record);
    let cut = &text[..text.len() - 3];
    assert_eq!(Record::from_csv(cut).unwrap().times.len(), 4);
    assert_eq!(record.column("b", ""), Some([0.0, 1.0, 2.0, 3.0, 4.0].as_slice()));
}

#[test]
fn other_texts_are_refused() {
    assert_eq!(Record::from_csv(""), Err(RecordError::NoHeading));
    assert_eq!(Record::from_csv("a,b\n1,2\n"), Err(RecordError::NoHeading));
    assert_eq!(Record::from_csv("time,a\n1,2\n1\n"), Err(RecordError::BadLine(3)));
    assert_eq!(Record::from_csv("time,a\n1,x\n"), Err(RecordError::BadLine(2)));
}
