//! The headers of Moodle's grading worksheet, which Moodle writes in the language of whoever downloads it.
//!
//! Source: Moodle's language packs of 2015 to 2026, strings `recordid`, `maxgrade`, `scale` and `lastmodifiedgrade` of `assign`,
//! `fullname`, `email`, `idnumber`, `username`, `grade` and `gradenoun` of the core, `pluginname` of `assignfeedback_comments`.

use crate::student::folded;

/// A column with a meaning.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Field {
    /// `Participant 12`: what Moodle's import goes by.
    Identifier,
    FullName,
    Email,
    IdNumber,
    Username,
    Grade,
    Maximum,
    /// The words of a scale, in place of a maximum.
    Scale,
    /// When the grade was changed: the import needs it.
    ModifiedGrade,
    Feedback,
}

impl Field {
    /// What it is called in messages.
    pub(super) fn words(self) -> &'static str {
        match self {
            Self::Identifier => "the participant (`Identifier`)",
            Self::FullName => "the name (`Full name`)",
            Self::Email => "the address (`Email address`)",
            Self::IdNumber => "the id (`ID number`)",
            Self::Username => "the login (`Username`)",
            Self::Grade => "the points (`Grade`)",
            Self::Maximum => "the maximum (`Maximum grade`)",
            Self::Scale => "the scale (`Scale`)",
            Self::ModifiedGrade => "the time of the grade (`Last modified (grade)`)",
            Self::Feedback => "the comment (`Feedback comments`)",
        }
    }

    /// Its header in every language.
    pub(super) fn headers(self) -> Vec<&'static str> {
        let all = LANGUAGES.iter().flat_map(|language| language.headers(self));
        all.copied().collect()
    }
}

/// The headers in one language, with those of earlier versions.
#[derive(Debug)]
pub(super) struct Language {
    /// Whether Moodle writes numbers with a decimal comma in it.
    pub(super) has_decimal_comma: bool,
    identifier: &'static [&'static str],
    full_name: &'static [&'static str],
    email: &'static [&'static str],
    id_number: &'static [&'static str],
    username: &'static [&'static str],
    grade: &'static [&'static str],
    maximum: &'static [&'static str],
    scale: &'static [&'static str],
    modified_grade: &'static [&'static str],
    feedback: &'static [&'static str],
}

impl Language {
    fn headers(&self, field: Field) -> &'static [&'static str] {
        match field {
            Field::Identifier => self.identifier,
            Field::FullName => self.full_name,
            Field::Email => self.email,
            Field::IdNumber => self.id_number,
            Field::Username => self.username,
            Field::Grade => self.grade,
            Field::Maximum => self.maximum,
            Field::Scale => self.scale,
            Field::ModifiedGrade => self.modified_grade,
            Field::Feedback => self.feedback,
        }
    }

    /// Whether a header is that of `field` in this language.
    pub(super) fn has(&self, field: Field, header: &str) -> bool {
        let mut headers = self.headers(field).iter();
        headers.any(|known| folded(known) == folded(header))
    }
}

/// English first: what sites in other languages leave untranslated is in English.
pub(super) const LANGUAGES: &[Language] = &[
    ENGLISH, GERMAN, FRENCH, SPANISH, ITALIAN, DUTCH, PORTUGUESE, SWEDISH, CATALAN,
];

const ENGLISH: Language = Language {
    has_decimal_comma: false,
    identifier: &["Identifier"],
    full_name: &["Full name"],
    email: &["Email address"],
    id_number: &["ID number"],
    username: &["Username"],
    grade: &["Grade"],
    maximum: &["Maximum grade"],
    scale: &["Scale"],
    modified_grade: &["Last modified (grade)"],
    feedback: &["Feedback comments"],
};

const GERMAN: Language = Language {
    has_decimal_comma: true,
    identifier: &["ID"],
    full_name: &["Vollständiger Name"],
    email: &["E-Mail-Adresse"],
    id_number: &["ID-Nummer"],
    username: &["Anmeldename"],
    grade: &["Bewertung"],
    maximum: &["Bestwertung"],
    scale: &["Skala"],
    modified_grade: &["Zuletzt geändert (Bewertung)"],
    feedback: &["Feedback als Kommentar"],
};

const FRENCH: Language = Language {
    has_decimal_comma: true,
    identifier: &["Identifiant"],
    full_name: &["Nom complet"],
    email: &["Adresse de courriel"],
    id_number: &["Numéro d’identification", "Numéro d'identification"],
    username: &["Nom d’utilisateur", "Nom d'utilisateur"],
    grade: &["Note"],
    maximum: &["Note maximale"],
    scale: &["Barème"],
    modified_grade: &["Dernière modification (note)"],
    feedback: &["Feedback par commentaires"],
};

const SPANISH: Language = Language {
    has_decimal_comma: true,
    identifier: &["Identificador"],
    full_name: &["Nombre completo"],
    email: &[
        "Dirección de correo",
        "Dirección Email",
        "Correo electrónico",
    ],
    id_number: &["Número de ID"],
    username: &["Nombre de usuario"],
    grade: &["Calificación"],
    maximum: &["Calificación máxima"],
    scale: &["Escala"],
    modified_grade: &["Última modificación (calificación)"],
    feedback: &["Comentarios de retroalimentación"],
};

const ITALIAN: Language = Language {
    has_decimal_comma: true,
    identifier: &["Identificativo"],
    full_name: &["Nome"],
    email: &["Indirizzo email"],
    id_number: &["Codice identificativo"],
    username: &["Username"],
    grade: &["Valutazione"],
    maximum: &["Valutazione massima"],
    scale: &["Scala"],
    modified_grade: &["Ultima modifica (valutazione)"],
    feedback: &["Commenti"],
};

const DUTCH: Language = Language {
    has_decimal_comma: true,
    identifier: &["Identificatie"],
    full_name: &["Volledige naam"],
    email: &["E-mailadres"],
    id_number: &["Nummer (ID)"],
    username: &["Gebruikersnaam"],
    grade: &["Cijfer", "Beoordeling"],
    maximum: &["Maximaal cijfer"],
    scale: &["Schaal"],
    modified_grade: &["Laatst gewijzigd (beoordeling)"],
    feedback: &["Feedback tekstvak", "Feedback"],
};

/// Of Portugal, then of Brazil where it differs.
const PORTUGUESE: Language = Language {
    has_decimal_comma: true,
    identifier: &["Identificador", "Número de identificação"],
    full_name: &["Nome completo"],
    email: &["Endereço de e-mail", "E-mail", "Endereço de email"],
    id_number: &["Número de identificação (ID)", "Código de identificação"],
    username: &["Nome de utilizador", "Identificação de usuário"],
    grade: &["Avaliação", "Nota"],
    maximum: &["Nota máxima"],
    scale: &["Escala"],
    modified_grade: &[
        "Última atualização (avaliação)",
        "Última modificação (nota)",
    ],
    feedback: &["Comentários de feedback"],
};

const SWEDISH: Language = Language {
    has_decimal_comma: true,
    identifier: &["Identifierare"],
    full_name: &["Fullständigt namn", "Hela namnet"],
    email: &["E-postadress"],
    id_number: &["ID nummer"],
    username: &["Användarnamn"],
    grade: &["Betyg"],
    maximum: &["Maxbetyg", "Maximalt betyg"],
    scale: &["Skala"],
    modified_grade: &["Senast modifierat (betyg)"],
    feedback: &["Återkopplingskommentarer", "Återkoppling/kommentarer"],
};

const CATALAN: Language = Language {
    has_decimal_comma: true,
    identifier: &["Identificador"],
    full_name: &["Nom complet"],
    email: &["Adreça electrònica"],
    id_number: &["Número ID"],
    username: &["Nom d'usuari", "Nom d’usuari"],
    grade: &["Qualificació"],
    maximum: &["Qualificació màxima"],
    scale: &["Escala"],
    modified_grade: &["Darrera modificació (qualificació)"],
    feedback: &["Comentaris de retroacció", "Comentaris de retroacció."],
};

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn no_header_has_two_meanings() {
        let mut meanings: BTreeMap<String, Field> = BTreeMap::new();
        for field in [
            Field::Identifier,
            Field::FullName,
            Field::Email,
            Field::IdNumber,
            Field::Username,
            Field::Grade,
            Field::Maximum,
            Field::Scale,
            Field::ModifiedGrade,
            Field::Feedback,
        ] {
            for header in field.headers() {
                let known = *meanings.entry(folded(header)).or_insert(field);
                assert_eq!(known, field, "{header}");
            }
        }
    }
}
